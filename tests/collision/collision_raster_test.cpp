#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "reference/collision/collision_pass.hpp"
#include "tests/collision/collision_scenes.hpp"

namespace lockstep::test::collision_raster_test {

namespace {

constexpr float quiet_nan = std::numeric_limits<float>::quiet_NaN();

Particles at(std::vector<glm::vec3> positions) {
    Particles p;
    p.resize(positions.size());
    p.position = std::move(positions);
    return p;
}

struct Drawn {
    CollisionImage cdt;
    DepthImage depth;
};

Drawn draw(const Particles& before, const Particles& after, const FrameParams& params, const Profile& profile = {}) {
    Drawn drawn{empty_cdt(params), DepthImage(params.width, params.height, 1.0F)};
    rasterise_particles(before, after, params, profile, drawn.cdt, drawn.depth);
    return drawn;
}

Drawn draw(const std::vector<glm::vec3>& positions, const FrameParams& params = flat_params(),
           const Profile& profile = {}) {
    return draw(at(positions), at(positions), params, profile);
}

int drawn_texels(const Drawn& drawn) {
    int count = 0;
    for (const glm::vec4& texel : drawn.cdt.texels)
        count += texel != glm::vec4(0.0F);
    return count;
}

} // namespace

TEST_CASE("raster: a point stores its position and depth in the texel it lies in") {
    const glm::vec3 p{0.1F, -0.6F, 0.5F}; // texel 4.4, 1.6
    const Drawn drawn = draw({p});
    CHECK(drawn.cdt.at(4, 1) == glm::vec4(p, 1.0F));
    CHECK(drawn.depth.at(4, 1) == 0.75F);
    CHECK(drawn_texels(drawn) == 1);
    const PointFragment fragment = point_fragment(p, flat_params(), {});
    CHECK((fragment.x == 4 && fragment.y == 1 && fragment.depth == 0.75F));
}

TEST_CASE("raster: a point on a texel edge goes to the lower texel, as one within 1/512 above it does") {
    CHECK(draw({{0.25F, 0.5F, 0.0F}}).cdt.at(4, 5).a == 1.0F); // window 5, 6
    const float just_above = 0.25F + 1.0F / 4096.0F;           // window 5 + 1/1024
    CHECK(point_fragment({just_above, 0.0F, 0.0F}, flat_params(), {}).x == 4);
    CHECK(base_texel({just_above, 0.0F, 0.0F}, flat_params(), {}).x == 5);
    Profile upper;
    upper.raster.point_edge_to_lower = false;
    CHECK(draw({{0.25F, 0.5F, 0.0F}}, flat_params(), upper).cdt.at(5, 6).a == 1.0F);
}

TEST_CASE("raster: the clip volume's right edge is drawn, its left edge falls on texel -1") {
    CHECK(drawn_texels(draw({{1.0F, 0.125F, 0.0F}})) == 1);
    CHECK(draw({{1.0F, 0.125F, 0.0F}}).cdt.at(7, 4).a == 1.0F);
    CHECK(drawn_texels(draw({{-1.0F, 0.125F, 0.0F}})) == 0);
    CHECK(drawn_texels(draw({{0.125F, -1.0F, 0.0F}})) == 0);
    CHECK(point_fragment({-1.0F, 0.125F, 0.0F}, flat_params(), {}).x == -1);
    Profile upper;
    upper.raster.point_edge_to_lower = false;
    CHECK(drawn_texels(draw({{-1.0F, 0.125F, 0.0F}}, flat_params(), upper)) == 1);
    CHECK(drawn_texels(draw({{1.0F, 0.125F, 0.0F}}, flat_params(), upper)) == 0);
}

TEST_CASE("raster: nothing is drawn outside the clip volume, behind the camera or at NaN") {
    const float out = std::nextafter(1.0F, 2.0F);
    CHECK(drawn_texels(draw({{out, 0.1F, 0.0F},
                             {0.1F, -out, 0.0F},
                             {0.1F, 0.1F, out},
                             {0.1F, 0.1F, -out},
                             {quiet_nan, 0.1F, 0.0F},
                             {0.1F, quiet_nan, 0.0F},
                             {0.1F, 0.1F, quiet_nan}})) == 0);
    FrameParams params = flat_params();
    params.collision_proj_view[3][3] = -1.0F;
    CHECK(drawn_texels(draw({{0.1F, 0.1F, 0.1F}}, params)) == 0);
    params.collision_proj_view = glm::mat4(0.0F);
    CHECK(drawn_texels(draw({{0.1F, 0.1F, 0.1F}}, params)) == 0);
}

TEST_CASE("raster: perspective divides by w, whatever switch perspective_divide says of the lookup") {
    FrameParams params = flat_params();
    params.collision_proj_view[3][3] = 2.0F;
    for (const PerspectiveDivide value : {PerspectiveDivide::on, PerspectiveDivide::off}) {
        params.switches.perspective_divide = value;
        const PointFragment fragment = point_fragment({1.25F, -1.75F, 1.0F}, params, {});
        CHECK((fragment.x == 6 && fragment.y == 0)); // 4 * 0.625 + 4 = 6.5, 4 * -0.875 + 4 = 0.5
        CHECK(fragment.depth == 0.75F);
    }
}

TEST_CASE("raster: the nearest point stays, whatever the order") {
    const glm::vec3 near{0.1F, 0.1F, -0.5F}, far{0.15F, 0.15F, 0.5F};
    CHECK(draw({near, far}).cdt.at(4, 4) == glm::vec4(near, 1.0F));
    CHECK(draw({far, near}).cdt.at(4, 4) == glm::vec4(near, 1.0F));
    CHECK(draw({far, near}).depth.at(4, 4) == 0.25F);
}

TEST_CASE("raster: of equal depths the first particle stays") {
    const glm::vec3 first{0.1F, 0.1F, 0.5F}, second{0.15F, 0.15F, 0.5F};
    CHECK(draw({first, second}).cdt.at(4, 4) == glm::vec4(first, 1.0F));
    CHECK(draw({second, first}).cdt.at(4, 4) == glm::vec4(second, 1.0F));
    CHECK(draw({{0.1F, 0.1F, 0.75F}, second, first}).cdt.at(4, 4) == glm::vec4(second, 1.0F));
}

TEST_CASE("raster: what was drawn before stays unless a point is nearer") {
    const FrameParams params = flat_params();
    const glm::vec3 p{0.1F, 0.1F, 0.0F}; // depth 1/2
    const glm::vec4 obstacle{7.0F, 7.0F, 7.0F, 1.0F};
    for (const float depth : {0.25F, 0.5F, 0.75F}) {
        CollisionImage cdt = empty_cdt(params);
        DepthImage depths(8, 8, 1.0F);
        cdt.at(4, 4) = obstacle;
        depths.at(4, 4) = depth;
        rasterise_particles(at({p}), at({p}), params, {}, cdt, depths);
        CHECK(cdt.at(4, 4) == (depth > 0.5F ? glm::vec4(p, 1.0F) : obstacle));
        CHECK(depths.at(4, 4) == std::min(depth, 0.5F));
    }
}

TEST_CASE("raster: the near plane is drawn, the far plane is not below the cleared depth") {
    CHECK(draw({{0.1F, 0.1F, -1.0F}}).depth.at(4, 4) == 0.0F);
    CHECK(drawn_texels(draw({{0.1F, 0.1F, -1.0F}})) == 1);
    CHECK(drawn_texels(draw({{0.1F, 0.1F, 1.0F}})) == 0);
}

TEST_CASE("raster: switch raster_position: drawn where the particle is, or was; the stored position is the new one") {
    FrameParams params = flat_params();
    const Particles before = at({{-0.6F, 0.1F, 0.0F}});
    const Particles after = at({{0.6F, 0.1F, 0.5F}});
    const glm::vec4 stored(after.position[0], 1.0F);
    const Drawn updated = draw(before, after, params);
    CHECK(updated.cdt.at(6, 4) == stored);
    CHECK(updated.depth.at(6, 4) == 0.75F);
    params.switches.raster_position = RasterPosition::before_step;
    const Drawn kept = draw(before, after, params);
    CHECK(kept.cdt.at(1, 4) == stored);
    CHECK(kept.depth.at(1, 4) == 0.5F);
    CHECK(drawn_texels(kept) == 1);
}

TEST_CASE("raster: ties of depth between particles drawn where they were keep the first one's new position") {
    FrameParams params = flat_params();
    params.switches.raster_position = RasterPosition::before_step;
    const glm::vec3 same{0.1F, 0.1F, 0.0F};
    const Drawn drawn = draw(at({same, same}), at({{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}}), params);
    CHECK(drawn.cdt.at(4, 4) == glm::vec4(1.0F, 2.0F, 3.0F, 1.0F));
}

TEST_CASE("raster: switch cdt_format: a texel stores the position's code") {
    FrameParams params = flat_params();
    const glm::vec3 p{0.1F, 0.1F, 0.3F};
    CHECK(draw({p}, params).cdt.at(4, 4) == glm::vec4(p, 1.0F));
    params.switches.cdt_format = CdtFormat::rgba16f; // 0.1 = 1638.4 * 2^-14, 0.3 = 1228.8 * 2^-12
    const float tenth = 1638.0F * 0x1p-14F;
    CHECK(draw({p}, params).cdt.at(4, 4) == glm::vec4(tenth, tenth, 1229.0F * 0x1p-12F, 1.0F));
    params.switches.cdt_format = CdtFormat::rgba8; // 1.1 * 128 = 140.8, 1.3 * 128 = 166.4
    params.cdt_box = {glm::vec3(-1.0F), glm::vec3(-1.0F + 255.0F / 128.0F)};
    CHECK(draw({p}, params).cdt.at(4, 4) == glm::vec4(141.0F, 141.0F, 166.0F, 255.0F));
}

TEST_CASE("raster: the texels of a grid of points, one in each, hold each its own") {
    std::vector<glm::vec3> positions;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            positions.emplace_back(static_cast<float>(x - 4) * 0.25F + 0.1F, static_cast<float>(y - 4) * 0.25F + 0.2F,
                                   0.1F);
    const Drawn drawn = draw(positions);
    for (std::size_t i = 0; i < positions.size(); ++i)
        CHECK(drawn.cdt.texels[i] == glm::vec4(positions[i], 1.0F));
}

} // namespace lockstep::test::collision_raster_test
