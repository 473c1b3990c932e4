#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "reference/collision/collision_pass.hpp"
#include "tests/collision/collision_scenes.hpp"

namespace lockstep::test::collision_pass_test {

namespace {

constexpr float quiet_nan = std::numeric_limits<float>::quiet_NaN();

Particles step(const Particles& before, const CollisionImage& cdt, const FrameParams& params,
               const Profile& profile = {}) {
    Particles after;
    update_particles(before, cdt, params, profile, after);
    return after;
}

/// The CDT of flat_params() with `stored` in the texel right of texel (4, 4), where a particle at `home` searches.
const glm::vec3 home{0.125F, 0.125F, 0.0F};

CollisionImage with_neighbour(const FrameParams& params, glm::vec3 stored) {
    CollisionImage cdt = empty_cdt(params);
    store(cdt, params, 5, 4, stored);
    return cdt;
}

} // namespace

TEST_CASE("collision: without a neighbour gravity moves the particle") {
    const FrameParams params = flat_params();
    const Particles after = step(falling(home), empty_cdt(params), params);
    // The sum (3, 0, 0) + (0, -8, 0) * 0.5 has length 5; 1/5 rounds to 0.2F, 3 * 0.2F to 0.6F, 4 * 0.2F to 0.8F;
    // 0.6F * 5 = 3 + 2^-23 ties to 3, 0.8F * 5 rounds to 4.
    CHECK(after.direction[0] == glm::vec3(0.6F, -0.8F, 0.0F));
    CHECK(after.speed[0] == 5.0F);
    CHECK(after.collide_time[0] == -1.5F);
    CHECK(after.position[0] == home + glm::vec3(1.5F, -2.0F, 0.0F));
}

TEST_CASE("collision: a neighbour within range turns the particle away from it") {
    const FrameParams params = flat_params();
    const Particles after = step(falling(home), with_neighbour(params, home + glm::vec3(0.25F, 0.0F, 0.0F)), params);
    // Apart (-1/4, 0, 0), length 1/4: direction -x; speed 3 * 1/2; step 1.5 * tick 0.5.
    CHECK(after.direction[0] == glm::vec3(-1.0F, 0.0F, 0.0F));
    CHECK(after.speed[0] == 1.5F);
    CHECK(after.collide_time[0] == 0.125F);
    CHECK(after.position[0] == home - glm::vec3(0.75F, 0.0F, 0.0F));
}

TEST_CASE("collision: at rest without gravity no direction is left, NaN") {
    FrameParams params = flat_params();
    params.constants.gravity = glm::vec3(0.0F);
    Particles resting = falling(home);
    resting.speed[0] = 0.0F;
    const Particles after = step(resting, empty_cdt(params), params);
    CHECK(after.speed[0] == 0.0F);
    CHECK(std::isnan(after.direction[0].x));
    CHECK(std::isnan(after.position[0].x));
}

TEST_CASE("collision: the nearest of several is answered") {
    const FrameParams params = flat_params();
    CollisionImage cdt = empty_cdt(params);
    store(cdt, params, 3, 3, home + glm::vec3(0.375F, 0.0F, 0.0F));
    store(cdt, params, 4, 5, home + glm::vec3(0.0F, 0.25F, 0.0F));
    store(cdt, params, 5, 5, home + glm::vec3(0.0F, 0.0F, 0.3125F));
    CHECK(step(falling(home), cdt, params).direction[0] == glm::vec3(0.0F, -1.0F, 0.0F));
}

TEST_CASE("collision: of equal distances the first in row order wins") {
    const FrameParams params = flat_params();
    CollisionImage cdt = empty_cdt(params);
    store(cdt, params, 5, 4, home + glm::vec3(0.25F, 0.0F, 0.0F));
    store(cdt, params, 3, 4, home + glm::vec3(0.0F, 0.0F, 0.25F));
    CHECK(step(falling(home), cdt, params).direction[0] == glm::vec3(0.0F, 0.0F, -1.0F));
    store(cdt, params, 5, 3, home + glm::vec3(0.0F, 0.25F, 0.0F));
    CHECK(step(falling(home), cdt, params).direction[0] == glm::vec3(0.0F, -1.0F, 0.0F));
}

TEST_CASE("collision: squares that differ but share a rounded root are equal distances") {
    FrameParams params = flat_params();
    params.constants.collision_range = 2.0F;
    CollisionImage cdt = empty_cdt(params);
    // 1 + (3 * 2^-13)^2 = 1 + 1.125 * 2^-23 rounds to 1 + 2^-23, whose root lies just below 1 + 2^-24 and rounds to 1.
    store(cdt, params, 3, 4, home + glm::vec3(0.0F, 1.0F, 3.0F * 0x1p-13F));
    store(cdt, params, 5, 4, home + glm::vec3(1.0F, 0.0F, 0.0F));
    CHECK(step(falling(home), cdt, params).direction[0].x == 0.0F);
}

TEST_CASE("collision: a distance equal to the range is out of it") {
    FrameParams params = flat_params();
    const CollisionImage cdt = with_neighbour(params, home + glm::vec3(0.25F, 0.0F, 0.0F));
    params.constants.collision_range = 0.25F;
    CHECK_FALSE(collided(step(falling(home), cdt, params)));
    params.constants.collision_range = std::nextafter(0.25F, 1.0F);
    CHECK(collided(step(falling(home), cdt, params)));
}

TEST_CASE("collision: the listing's first best distance of 100000 bounds every range") {
    FrameParams params = flat_params();
    params.constants.collision_range = 1e6F;
    CHECK_FALSE(collided(step(falling(home), with_neighbour(params, {0.0F, 0.0F, 100001.0F}), params)));
    CHECK(collided(step(falling(home), with_neighbour(params, {0.0F, 0.0F, 99999.0F}), params)));
}

TEST_CASE("collision: the neighbourhood is a square of the given radius without its centre") {
    FrameParams params = flat_params();
    for (int radius = 0; radius <= 3; ++radius)
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) {
                params.constants.texel_collide_range = radius;
                CollisionImage cdt = empty_cdt(params);
                store(cdt, params, x, y, home + glm::vec3(0.25F, 0.0F, 0.0F));
                const int distance = std::max(std::abs(x - 4), std::abs(y - 4));
                INFO("radius " << radius << ", texel " << x << ", " << y);
                CHECK(collided(step(falling(home), cdt, params)) == (distance > 0 && distance <= radius));
            }
}

TEST_CASE("collision: switch search_when: only a negative collide time searches") {
    const FrameParams params = flat_params();
    const CollisionImage cdt = with_neighbour(params, home + glm::vec3(0.25F, 0.0F, 0.0F));
    const auto searches = [&](float collide_time, bool flush = true) {
        Particles p = falling(home);
        p.collide_time[0] = collide_time;
        Profile profile;
        profile.flush_subnormals = flush;
        return collided(step(p, cdt, params, profile));
    };
    CHECK(searches(-std::numeric_limits<float>::min()));
    CHECK_FALSE(searches(0.0F));
    CHECK_FALSE(searches(-0.0F));
    CHECK_FALSE(searches(0.5F));
    CHECK_FALSE(searches(quiet_nan));
    CHECK_FALSE(searches(-1e-40F, true)); // subnormal: zero
    CHECK(searches(-1e-40F, false));
}

TEST_CASE("collision: switch perspective_divide: clip x, y, divided by w or taken as they are") {
    FrameParams params = flat_params();
    params.collision_proj_view[3][3] = 2.0F; // w = 2
    // On: (0.75 / 2 + 1) * 0.5 * 8 = 5.5. Off: (0.75 + 1) * 0.5 * 8 = 7.
    BaseTexelIndex texel = base_texel({0.75F, -0.75F, 0.0F}, params, {});
    CHECK((texel.x == 5 && texel.y == 2));
    params.switches.perspective_divide = PerspectiveDivide::off;
    texel = base_texel({0.75F, -0.75F, 0.0F}, params, {});
    CHECK((texel.x == 7 && texel.y == 1));
}

TEST_CASE("collision: switch base_texel: texel -0.5 is texel 0 by truncation, outside by floor") {
    FrameParams params = flat_params();
    const auto x_of = [&](float position) { return base_texel({position, 0.0F, 0.0F}, params, {}).x; };
    const auto y_of = [&](float position) { return base_texel({0.0F, position, 0.0F}, params, {}).y; };
    for (const BaseTexel value : {BaseTexel::floor, BaseTexel::truncate}) {
        params.switches.base_texel = value;
        const int half_outside = value == BaseTexel::truncate ? 0 : -1;
        CHECK(x_of(-1.125F) == half_outside); // 4 * -1.125 + 4 = -0.5
        CHECK(y_of(-1.125F) == half_outside);
        CHECK(x_of(-1.25F) == -1);
        CHECK(x_of(-1.0F) == 0);
        CHECK(x_of(-0.8F) == 0);
        CHECK(y_of(-0.75F) == 1);
        CHECK(x_of(0.99F) == 7);
        CHECK(x_of(1.0F) == -1);
        CHECK(y_of(1.0F) == -1);
        CHECK(x_of(quiet_nan) == -1);
        CHECK(x_of(1e30F) == -1);
    }
    // Both or neither: a particle outside in y has no texel at all, at texel -1 exactly neither.
    CHECK(base_texel({0.0F, 2.0F, 0.0F}, params, {}).x == -1);
    CHECK(base_texel({0.0F, -1.25F, 0.0F}, params, {}).x == -1);
}

TEST_CASE("collision: a particle whose base texel lies outside does not search") {
    FrameParams params = flat_params();
    const glm::vec3 edge{-1.125F, 0.125F, 0.0F};
    CollisionImage cdt = empty_cdt(params);
    store(cdt, params, 1, 4, edge + glm::vec3(0.25F, 0.0F, 0.0F));
    CHECK_FALSE(collided(step(falling(edge), cdt, params)));
    params.switches.base_texel = BaseTexel::truncate;
    CHECK(collided(step(falling(edge), cdt, params)));
}

TEST_CASE("collision: switch self_position: from the vertex, or from whoever owns the base texel") {
    FrameParams params = flat_params();
    CollisionImage cdt = with_neighbour(params, home + glm::vec3(0.25F, 0.0F, 0.0F));
    store(cdt, params, 4, 4, home + glm::vec3(0.25F, 0.25F, 0.0F));
    CHECK(step(falling(home), cdt, params).direction[0] == glm::vec3(-1.0F, 0.0F, 0.0F));
    params.switches.self_position = SelfPosition::texel;
    const Particles after = step(falling(home), cdt, params);
    CHECK(after.direction[0] == glm::vec3(0.0F, 1.0F, 0.0F));
    CHECK(after.position[0] == home + glm::vec3(0.0F, 0.75F, 0.0F)); // moves from the vertex all the same
}

TEST_CASE("collision: switch empty_texel: a cleared texel is a particle at the origin, or none") {
    FrameParams params = flat_params();
    params.switches.empty_texel = EmptyTexel::phantom;
    const glm::vec3 p{0.0F, 0.25F, 0.0F};
    CHECK(step(falling(p), empty_cdt(params), params).direction[0] == glm::vec3(0.0F, 1.0F, 0.0F));
    params.switches.empty_texel = EmptyTexel::skip;
    CHECK_FALSE(collided(step(falling(p), empty_cdt(params), params)));
    // With skip, validity is alpha, not the position: a particle stored at the origin counts.
    CHECK(collided(step(falling(p), with_neighbour(params, glm::vec3(0.0F)), params)));
}

TEST_CASE("collision: an empty base texel as self: the origin with phantom, no search with skip") {
    FrameParams params = flat_params();
    params.switches.self_position = SelfPosition::texel;
    params.switches.empty_texel = EmptyTexel::phantom;
    const CollisionImage cdt = with_neighbour(params, {0.25F, 0.0F, 0.0F});
    params.switches.zero_distance = ZeroDistance::skip;
    CHECK(step(falling(home), cdt, params).direction[0] == glm::vec3(-1.0F, 0.0F, 0.0F));
    params.switches.empty_texel = EmptyTexel::skip;
    CHECK_FALSE(collided(step(falling(home), cdt, params)));
}

TEST_CASE("collision: the listing at its word divides by zero between two empty texels") {
    FrameParams params = flat_params();
    params.switches = preset("paper");
    const Particles after = step(falling(home), empty_cdt(params), params);
    CHECK(collided(after));
    CHECK(std::isnan(after.direction[0].x));
    CHECK(std::isnan(after.position[0].y));
    CHECK(after.speed[0] == 3.0F * 0.2F);
}

TEST_CASE("collision: switch zero_distance: a neighbour at the same place is a hit, or passed over") {
    FrameParams params = flat_params();
    CollisionImage cdt = with_neighbour(params, home);
    params.switches.zero_distance = ZeroDistance::hit;
    CHECK(std::isnan(step(falling(home), cdt, params).direction[0].x));
    params.switches.zero_distance = ZeroDistance::skip;
    CHECK_FALSE(collided(step(falling(home), cdt, params)));
    store(cdt, params, 3, 4, home + glm::vec3(0.0F, 0.25F, 0.0F));
    CHECK(step(falling(home), cdt, params).direction[0] == glm::vec3(0.0F, -1.0F, 0.0F));
}

TEST_CASE("collision: switch outside_image: no texel beyond an edge is read, nor the next row instead") {
    FrameParams params = flat_params();
    params.constants.texel_collide_range = 2;
    // The origin lies in the corner texel (0, 0); an outside texel read as cleared would be a phantom there.
    params.collision_proj_view[3][0] = params.collision_proj_view[3][1] = -0.875F;
    params.switches.empty_texel = EmptyTexel::phantom;
    CollisionImage cdt = empty_cdt(params);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x)
            store(cdt, params, x, y, glm::vec3(9.0F));
    CHECK_FALSE(collided(step(falling({0.0625F, 0.0F, 0.0F}), cdt, params)));

    params = flat_params();
    cdt = empty_cdt(params);
    const glm::vec3 right_edge{0.875F, 0.125F, 0.0F};
    store(cdt, params, 0, 4, right_edge + glm::vec3(0.25F, 0.0F, 0.0F));
    store(cdt, params, 0, 5, right_edge + glm::vec3(0.25F, 0.0F, 0.0F));
    CHECK_FALSE(collided(step(falling(right_edge), cdt, params)));
    const glm::vec3 left_edge{-0.875F, 0.125F, 0.0F};
    cdt = empty_cdt(params);
    store(cdt, params, 7, 4, left_edge + glm::vec3(0.25F, 0.0F, 0.0F));
    store(cdt, params, 7, 3, left_edge + glm::vec3(0.25F, 0.0F, 0.0F));
    CHECK_FALSE(collided(step(falling(left_edge), cdt, params)));
}

TEST_CASE("collision: switch speed_factor scales the speed at a hit, and only there") {
    FrameParams params = flat_params();
    params.switches.speed_factor = 0.25F;
    const CollisionImage cdt = with_neighbour(params, home + glm::vec3(0.25F, 0.0F, 0.0F));
    CHECK(step(falling(home), cdt, params).speed[0] == 0.75F);
    CHECK(step(falling(home), empty_cdt(params), params).speed[0] == 5.0F);
}

TEST_CASE("collision: switch collision_step: a hit moves by a second's way, or by a tick's") {
    FrameParams params = flat_params();
    const CollisionImage cdt = with_neighbour(params, home + glm::vec3(0.25F, 0.0F, 0.0F));
    CHECK(step(falling(home), cdt, params).position[0] == home - glm::vec3(0.75F, 0.0F, 0.0F));
    params.switches.collision_step = CollisionStep::full;
    CHECK(step(falling(home), cdt, params).position[0] == home - glm::vec3(1.5F, 0.0F, 0.0F));
}

TEST_CASE("collision: switch cdt_format: the stored code is what a neighbour's position is read from") {
    FrameParams params = flat_params();
    params.switches.cdt_format = CdtFormat::rgba16f;
    CollisionImage cdt = with_neighbour(params, {0.125F, 0.125F, 0.1F});
    params.constants.collision_range = 0.1F; // 0.1 stores as the half 1638 * 2^-14, which lies below
    CHECK(collided(step(falling(home), cdt, params)));
    params.switches.cdt_format = CdtFormat::rgba32f;
    CHECK_FALSE(collided(step(falling(home), with_neighbour(params, {0.125F, 0.125F, 0.1F}), params)));

    // Codes c stand for -1 + c / 128: 0.125 is 144; z 0.1 is (1.1 * 128 = 140.8) 141, 13/128.
    params.switches.cdt_format = CdtFormat::rgba8;
    params.cdt_box = {glm::vec3(-1.0F), glm::vec3(-1.0F + 255.0F / 128.0F)};
    cdt = with_neighbour(params, {0.125F, 0.125F, 0.1F});
    CHECK(cdt.at(5, 4) == glm::vec4(144.0F, 144.0F, 141.0F, 255.0F));
    params.constants.collision_range = 13.0F / 128.0F;
    CHECK_FALSE(collided(step(falling(home), cdt, params)));
    params.constants.collision_range = std::nextafter(13.0F / 128.0F, 1.0F);
    CHECK(collided(step(falling(home), cdt, params)));
    // The phantom of a cleared rgba8 texel is the box's corner, code 0.
    params.switches.empty_texel = EmptyTexel::phantom;
    params.constants.collision_range = 0.5F;
    CHECK(step(falling({-1.0F, -0.75F, -1.0F}), empty_cdt(params), params).direction[0] == glm::vec3(0.0F, 1.0F, 0.0F));
}

TEST_CASE("collision: a particle with NaN anywhere in its position neither searches nor spreads it") {
    const FrameParams params = flat_params();
    for (int axis = 0; axis < 2; ++axis) {
        glm::vec3 broken = home;
        broken[axis] = quiet_nan;
        Particles both = falling(broken);
        const Particles whole = falling(home);
        both.position.push_back(whole.position[0]);
        both.direction.push_back(whole.direction[0]);
        both.speed.push_back(whole.speed[0]);
        both.collide_time.push_back(whole.collide_time[0]);
        const Particles after = step(both, with_neighbour(params, home + glm::vec3(0.25F, 0.0F, 0.0F)), params);
        CHECK_FALSE(collided(after, 0));
        CHECK(std::isnan(after.position[0][axis]));
        CHECK(after.position[0].z == 0.0F);
        CHECK(collided(after, 1));
        CHECK(after.position[1] == home - glm::vec3(0.75F, 0.0F, 0.0F));
    }
}

TEST_CASE("collision: a stored NaN is never within range") {
    const FrameParams params = flat_params();
    CollisionImage cdt = with_neighbour(params, {quiet_nan, 0.125F, 0.0F});
    CHECK_FALSE(collided(step(falling(home), cdt, params)));
    store(cdt, params, 5, 5, home + glm::vec3(0.0F, 0.25F, 0.0F));
    CHECK(step(falling(home), cdt, params).direction[0] == glm::vec3(0.0F, -1.0F, 0.0F));
}

TEST_CASE("collision: the profile's order of sums reaches distance, direction and speed") {
    FrameParams params = flat_params();
    params.constants.tick = 1.0F;
    params.constants.gravity = glm::vec3(0.0F);
    const glm::vec3 v{9181.0F / 4096.0F, 7089.0F / 4096.0F, 4141.0F / 4096.0F}; // arithmetic_test.cpp
    Particles flying = falling(glm::vec3(0.0F));
    flying.direction[0] = v;
    flying.speed[0] = 1.0F;
    const auto check = [&](DotOrder order, float length, float direction_x) {
        Profile profile;
        profile.dot = order;
        params.constants.collision_range = 4.0F;
        const Particles free = step(flying, empty_cdt(params), params, profile);
        CHECK(free.speed[0] == length);
        CHECK(free.direction[0].x == direction_x);
        const CollisionImage cdt = with_neighbour(params, -v);
        CHECK(step(falling(glm::vec3(0.0F)), cdt, params, profile).direction[0].x == direction_x);
        params.constants.collision_range = length;
        CHECK_FALSE(collided(step(falling(glm::vec3(0.0F)), cdt, params, profile)));
        params.constants.collision_range = std::nextafter(length, 4.0F);
        CHECK(collided(step(falling(glm::vec3(0.0F)), cdt, params, profile)));
    };
    check(DotOrder::left_to_right, 0x1.80e2d2p+1F, 0x1.7da93ap-1F);
    check(DotOrder::right_to_left, 0x1.80e2d4p+1F, 0x1.7da938p-1F);
    check(DotOrder::fused_chain, 0x1.80e2d6p+1F, 0x1.7da936p-1F);
}

} // namespace lockstep::test::collision_pass_test
