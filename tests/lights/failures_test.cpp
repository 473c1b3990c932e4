#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "crosscheck/lights/scene.hpp"
#include "reference/half.hpp"
#include "reference/triangle_interpolation.hpp"
#include "tests/lights/lit_points.hpp"

namespace lockstep::test::failures_test {

/// The ways in which the published technique goes wrong, each with what is measured of it.
namespace lights = lockstep::lights;

namespace {

using Way = lights::Interpolation;
using S = lights::Supersample;

lights::Settings scene(const std::string& name, const std::string& preset = "corrected") {
    return lights::load_scene("data/scenes/lights/" + name + ".json", {.preset = preset});
}

LitPoints lit_scene(lights::Settings s) {
    s.width = s.height = 2;
    LitPoints points(std::move(s));
    points.step();
    return points;
}

struct Figures {
    double rms = 0.0;  ///< of lit against light without a grid, as a share of that
    double step = 0.0; ///< the largest between neighbours
};

/// Four hundred points along the floor of 16 m, which is at 1.5 m.
Figures along_floor(const LitPoints& points) {
    double error = 0.0, all = 0.0, step = 0.0, before = 0.0;
    for (int i = 0; i < 400; ++i) {
        const glm::vec3 p(1.0F + 14.0F * (static_cast<float>(i) + 0.5F) / 400.0F, 1.5F, 5.25F);
        const double is = double{points.lit(p, {0, 1, 0}, 1.0F).x}, right = points.truth(glm::dvec3(p));
        error += (is - right) * (is - right);
        all += right * right;
        step = i == 0 ? 0.0 : std::max(step, std::abs(is - before));
        before = is;
    }
    return {std::sqrt(error / all), step};
}

Figures figures(lights::Settings s, Way way, S samples) {
    s.switches.interpolation = way;
    s.switches.supersample = samples;
    return along_floor(lit_scene(std::move(s)));
}

/// A row of texels 0 1 1 1 from `first` on, sampled.
float beside_step(Way way, S samples, float u) {
    lights::Settings s = one_light();
    s.switches.interpolation = way;
    s.switches.supersample = samples;
    LitPoints points(s);
    for (int z = 0; z < 16; ++z)
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x)
                points.set({x, y, z}, {x < 8 ? 0.0F : 1.0F});
    return points.sampled({u, 5.5F, 5.5F})[0];
}

} // namespace

TEST_CASE("lights failures, stair_steps: nearest sampling steps at every voxel, interpolation does not") {
    const Figures nearest = figures(one_light(), Way::nearest, S::one),
                  halves = figures(one_light(), Way::nearest, S::two),
                  linear = figures(one_light(), Way::trilinear, S::one),
                  cubic = figures(one_light(), Way::tricubic, S::one);
    const auto told = [](const Figures& f) { return fmt::format("{:.1f} % / {:.4f}", 100.0 * f.rms, f.step); };
    CHECK(told(nearest) == "19.4 % / 0.0660");
    CHECK(told(halves) == "14.6 % / 0.0342");
    CHECK(told(linear) == "6.7 % / 0.0027");
    CHECK(told(cubic) == "1.7 % / 0.0028");
}

TEST_CASE("lights failures, supersample_bands: nearest with S = 2 leaves stairs of half the height") {
    CHECK(beside_step(Way::nearest, S::one, 7.99F) == 0.0F);
    CHECK(beside_step(Way::nearest, S::one, 8.01F) == 1.0F);
    CHECK(beside_step(Way::nearest, S::two, 7.7F) == 0.0F);
    CHECK(beside_step(Way::nearest, S::two, 7.99F) == 0.5F);
    CHECK(beside_step(Way::nearest, S::two, 8.26F) == 1.0F);
    // The more samples, the nearer to trilinear.
    double two = 0.0, four = 0.0;
    for (int i = 0; i < 64; ++i) {
        const float u = 7.0F + static_cast<float>(i) / 32.0F, right = beside_step(Way::trilinear, S::one, u);
        two += std::abs(double{beside_step(Way::nearest, S::two, u)} - double{right});
        four += std::abs(double{beside_step(Way::nearest, S::four, u)} - double{right});
    }
    CHECK(four < 0.6 * two);
}

TEST_CASE("lights failures, cubic_overshoot: beside a step tricubic is above it by 3 %, and below 0") {
    CHECK(beside_step(Way::tricubic, S::one, 8.5F + 0.7F) == Approx(1.0315).epsilon(1e-6));
    CHECK(beside_step(Way::tricubic, S::one, 8.5F + 0.7F) > 1.0F);
    CHECK(beside_step(Way::tricubic, S::one, 6.5F + 0.3F) == 0.0F); // clamped: else -0.0315
}

TEST_CASE("lights failures, half_voxel_shift: voxels' corners for their centres displace the light by half a voxel") {
    lights::Settings corner = one_light(), moved = one_light();
    corner.switches.voxel_point = lights::VoxelPoint::corner;
    moved.lights[0].position += 0.5F;
    const LitPoints a = lit_scene(corner), b = lit_scene(moved);
    std::size_t different = 0, lit = 0;
    for (std::size_t i = 0; i < a.host().grid().count(); ++i) {
        different += a.texel(i) == b.texel(i) ? 0 : 1;
        lit += a.texel(i)[3] > 0.0F ? 1 : 0;
    }
    CHECK(different == 0);
    CHECK(lit == 276);
}

TEST_CASE("lights failures, cancelling_lights: between two equal lights there is colour and no direction") {
    const auto between = [](const char* value, lights::ZeroDirection answer) {
        INFO(value);
        lights::Settings s = scene("two_opposed");
        s.switches.zero_direction = answer;
        s.switches.supersample = S::one;
        const LitPoints points = lit_scene(s);
        const LitPoints::Texel texel = points.texel(glm::ivec3{8, 1, 8});
        CHECK(texel[3] == 2.0F);
        CHECK(texel[0] > 0.0F);
        CHECK((texel[4] == 0.0F && texel[5] == 0.0F && texel[6] == 0.0F));
        return points.lit({0.5F, 1.5F, 0.5F}).x;
    };
    const float ambient = 0.5F / 64.0F;
    CHECK(between("undefined", lights::ZeroDirection::undefined) == ambient); // of NaN, of which max may make 0
    CHECK(between("unlit", lights::ZeroDirection::unlit) == ambient);
    CHECK(between("isotropic", lights::ZeroDirection::isotropic) > ambient);
}

TEST_CASE("lights failures, far_bias: of raw vectors the far light's is the longer one") {
    const auto cosine_to_far = [](lights::Direction direction) {
        lights::Settings s = one_light();
        s.switches.direction = direction;
        s.switches.direction_weight = lights::DirectionWeight::one;
        s.lights = {{.position = {8.5F, 4.0F, 8.5F}}, {.position = {11.5F, 3.5F, 8.5F}}}; // 0.5 m above, 3 m aside
        const LitPoints points = lit_scene(s);
        const LitPoints::Texel t = points.texel(glm::ivec3{8, 3, 8});
        return double{t[4]} / std::sqrt(double{t[4]} * t[4] + double{t[5]} * t[5] + double{t[6]} * t[6]);
    };
    CHECK(cosine_to_far(lights::Direction::unit) == Approx(std::sqrt(0.5)).epsilon(1e-6));
    CHECK(cosine_to_far(lights::Direction::raw) == Approx(3.0 / std::sqrt(9.25)).epsilon(1e-6)); // 0.986: 9 degrees off
}

TEST_CASE("lights failures, light_leak: a lamp below the floor colours what is lit from above") {
    lights::Settings s = scene("lamp_under_floor");
    const LitPoints both = lit_scene(s);
    s.lights.pop_back();
    const LitPoints above = lit_scene(s);
    const glm::vec3 p(0.5F, 3.0F, 0.5F);
    CHECK(above.lit(p).x == above.lit(p).y);
    CHECK(both.lit(p).x > both.lit(p).y);
    CHECK(both.truth(glm::dvec3(p)) == Approx(above.truth(glm::dvec3(p))).epsilon(1e-12)); // it shines from behind
}

TEST_CASE("lights failures, half_stall: sums of halves stop where an addend is half a unit") {
    float nearest = 0.0F, cut = 0.0F;
    std::array<float, 2> of_2000{};
    for (int i = 1; i <= 10'000; ++i) {
        nearest = half_round(nearest + 0.05F);
        cut = half_truncated(cut + 0.05F);
        if (i == 2000)
            of_2000 = {nearest, cut};
    }
    CHECK(of_2000[0] == 115.0625F);
    CHECK(of_2000[1] == 64.0F);
    CHECK(nearest == 128.0F);
    CHECK(cut == 64.0F);
    lights::Settings s = one_light(8);
    s.switches.accumulate = lights::Accumulate::blend;
    s.switches.volume_format = lights::Format::rgba16f;
    s.switches.attenuation = lights::Attenuation::none;
    s.lights.assign(2000, {.position = {4.25F, 3.5F, 4.75F}, .range = 1.0F, .colour = glm::vec3(0.05F)});
    CHECK(lit_scene(s).texel(glm::ivec3{4, 3, 4})[0] == 64.0F);
}

TEST_CASE("lights failures, fixed_overflow: a bit more than fits turns a sum's sign") {
    lights::Settings s = one_light(8);
    s.switches.accumulate = lights::Accumulate::fixed32;
    s.switches.attenuation = lights::Attenuation::none;
    s.lights.assign(1024, {.position = {4.5F, 3.5F, 4.5F}, .range = 1.5F, .colour = glm::vec3(1.0F)});
    CHECK(lights::most_fixed_bits(s) == 20);
    CHECK(lit_scene(s).texel(glm::ivec3{4, 3, 4})[0] == 1024.0F);
    s.fixed_bits = 21;
    CHECK_THROWS_WITH(host_of(s), Catch::Contains("fixed_bits is 21: 1024 lights of up to 1 would overflow"));
    CHECK(static_cast<std::int32_t>(1024U << 21U) < 0);
}

TEST_CASE("lights failures, edge_of_world: clamping smears the border outwards, black darkens within") {
    const auto at = [](lights::Outside outside, float x) {
        lights::Settings s = scene("edge_of_world");
        s.switches.outside = outside;
        s.switches.supersample = S::one;
        return lit_scene(s).lit({x, 0.5F, 0.5F}).x - 0.5F / 64.0F;
    };
    CHECK(at(lights::Outside::clamp, 9.0F) == at(lights::Outside::clamp, 15.0F));
    CHECK(at(lights::Outside::clamp, 15.0F) > 0.0F);
    CHECK(at(lights::Outside::black, 9.0F) == 0.0F);
    CHECK(at(lights::Outside::black, 7.75F) < 0.8F * at(lights::Outside::clamp, 7.75F));
    CHECK(at(lights::Outside::black, 7.5F) == at(lights::Outside::clamp, 7.5F));
}

TEST_CASE("lights failures, on_the_centre: a light on a voxel's point has no direction there") {
    lights::Settings s = one_light(8);
    s.lights[0].position = {4.5F, 3.5F, 4.5F};
    const LitPoints skipped = lit_scene(s);
    CHECK(skipped.texel(glm::ivec3{4, 3, 4}) == LitPoints::Texel{1, 1, 1, 1, 0, 0, 0, 1});
    s.switches.zero_distance = lights::ZeroDistance::undefined;
    s.switches.accumulate = lights::Accumulate::gather;
    CHECK(std::isnan(lit_scene(s).texel(glm::ivec3{4, 3, 4})[5]));
}

TEST_CASE("lights failures, slow_forward: every fragment samples, also those that nobody sees") {
    for (int planes = 1; planes <= 8; ++planes) {
        lights::Settings s = one_light();
        s.obstacles = {};
        for (int k = 0; k < planes; ++k)
            add_surface(s, plane_surface(64.0, 64.0), {8.0, 0.5 + 0.25 * k, 8.0}, {128, 128, 128});
        s.camera = {.eye = {8.0F, 10.0F, 8.01F}, .target = {8.0F, 0.0F, 8.0F}, .near_plane = 0.5F, .far_plane = 60.0F};
        const lights::Host host(s);
        int fragments = 0;
        for (std::size_t t = 0; t < s.obstacles.mesh.triangle_count(); ++t) {
            std::array<glm::vec4, 3> clip;
            for (std::size_t k = 0; k < 3; ++k)
                clip[k] = host.view_projection() *
                          glm::vec4(s.obstacles.mesh.positions[s.obstacles.mesh.indices[3 * t + k]], 1.0F);
            const TriangleInterpolation<Portable> triangle(Portable{}, clip, s.width, s.height);
            for (int pixel = 0; pixel < s.width * s.height; ++pixel)
                fragments += triangle.fragment(pixel % s.width, pixel / s.width) ? 1 : 0;
        }
        CHECK(fragments >= planes * s.width * s.height);                                 // deferred: one each
        CHECK(fragments <= planes * s.width * s.height + planes * (s.width + s.height)); // of a diagonal both triangles
    }
}

TEST_CASE("lights failures, run_to_run and lost_updates: order and races show, fixed point does not") {
    if (!gl())
        return skip(gl().missing());
    const auto two_runs = [](lights::Accumulate accumulate) {
        lights::Settings s = room(512);
        s.switches.accumulate = accumulate;
        s.switches.attenuation = lights::Attenuation::none;
        s.width = s.height = 8;
        const lights::HostPtr host = host_of(s);
        const System system = lights::system(host);
        std::array<SystemState, 2> seen{system.start, system.start};
        for (SystemState& state : seen) {
            GlSystemSide side(gl(), system, lights::passes(host), "shaders/lights", s.arithmetic);
            side.upload(system.start.view());
            for (std::size_t pass = 0; pass < 3; ++pass)
                side.step(pass, 0);
            side.read(state);
        }
        return seen;
    };
    const auto differing = [&](const std::array<SystemState, 2>& runs) {
        return compare(std::as_const(runs[0])[lights::accumulator_image],
                       std::as_const(runs[1])[lights::accumulator_image])
            .differing(lights::accumulator_image);
    };
    const auto sum_of_counts = [](const SystemState& state, std::size_t voxels) {
        double sum = 0.0;
        for (std::size_t i = 7 * voxels; i < 8 * voxels; ++i)
            sum += double{state.view().real(lights::field::word, i)};
        return sum;
    };
    CHECK(differing(two_runs(lights::Accumulate::fixed64)) == 0);
    const auto cas = two_runs(lights::Accumulate::float_cas), racing = two_runs(lights::Accumulate::racing);
    const std::size_t voxels = room().grid.count();
    INFO(fmt::format("float_cas: {} words differ from run to run; racing: {} of {} additions kept", differing(cas),
                     sum_of_counts(racing[0], voxels), sum_of_counts(cas[0], voxels)));
    CHECK(sum_of_counts(cas[0], voxels) == sum_of_counts(cas[1], voxels));
    CHECK(sum_of_counts(racing[0], voxels) <= sum_of_counts(cas[0], voxels));
}

} // namespace lockstep::test::failures_test
