#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <set>

#include "reference/collision/neighbours.hpp"
#include "reference/collision/octree_pass.hpp"
#include "tests/random_positions.hpp"

namespace lockstep::test::octree_pass_test {

namespace {

constexpr float size = 8.0F; // leaves of side 1

FrameParams params_of_range(float range) {
    FrameParams params;
    params.constants.octree_size = size;
    params.constants.collision_range = range;
    return params;
}

Particles at_rest(std::initializer_list<glm::vec3> positions) {
    Particles particles;
    for (const glm::vec3 position : positions) {
        particles.position.push_back(position);
        particles.direction.emplace_back(0.0F, -1.0F, 0.0F);
        particles.speed.push_back(1.0F);
        particles.collide_time.push_back(-1.0F);
    }
    return particles;
}

} // namespace

TEST_CASE("octree: leaves tile the root, and their lower sides are theirs") {
    CHECK(octree_leaf({-4.0F, -4.0F, -4.0F}, size) == 0);
    CHECK(octree_leaf({-3.0F, -4.0F, -4.0F}, size) == 1);
    CHECK(octree_leaf({-4.0F, -3.0F, -4.0F}, size) == 2);
    CHECK(octree_leaf({-4.0F, -4.0F, -3.0F}, size) == 4);
    CHECK(octree_leaf({-2.0F, -4.0F, -4.0F}, size) == 8);
    CHECK(octree_leaf({0.0F, 0.0F, 0.0F}, size) == 7 * 64);
    CHECK(octree_leaf({3.9F, 3.9F, 3.9F}, size) == 511);
    std::set<std::int32_t> leaves;
    for (int z = -4; z < 4; ++z)
        for (int y = -4; y < 4; ++y)
            for (int x = -4; x < 4; ++x)
                leaves.insert(octree_leaf(glm::vec3(x, y, z), size));
    CHECK(leaves.size() == 512);
    CHECK(*leaves.begin() == 0);
    CHECK(*leaves.rbegin() == 511);
}

TEST_CASE("octree: what lies outside the root, or is no number, is in no leaf") {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (const float out : {4.0F, -4.0001F, nan, infinity, -infinity})
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 position(0.0F);
            position[axis] = out;
            CAPTURE(out, axis);
            CHECK(octree_leaf(position, size) == no_leaf);
        }
}

TEST_CASE("octree: tiny coordinates count as 0, whatever their sign") {
    using Limits = std::numeric_limits<float>;
    const std::int32_t zero = octree_leaf(glm::vec3(0.0F), size);
    for (const float tiny : {-0.0F, -Limits::denorm_min(), Limits::denorm_min(), -Limits::min(), Limits::min()})
        CHECK(octree_leaf(glm::vec3(tiny), size) == zero);
    CHECK(octree_leaf(glm::vec3(-1.3e-38F), size) != zero);
}

TEST_CASE("octree: in one leaf the nearest within range is found, as brute force finds it") {
    std::vector<glm::vec3> positions = test::random_positions(400, 0.45F, 3);
    for (glm::vec3& p : positions)
        p += 0.5F; // all in one leaf
    const FrameParams params = params_of_range(0.1F);
    const auto partners = octree_partners(positions, {}, params, Profile{});
    const auto exact = find_neighbourhoods(positions, 0.1F);
    std::size_t found = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        CHECK(partners[i] == exact.particle[i].nearest);
        found += partners[i] >= 0 ? 1U : 0U;
    }
    CHECK(found > 200);
    CHECK(found < 400);
}

TEST_CASE("octree: over many leaves only what shares a leaf is found") {
    const std::vector<glm::vec3> positions = test::random_positions(3000, 4.2F, 4);
    const FrameParams params = params_of_range(0.3F);
    const auto partners = octree_partners(positions, {}, params, Profile{});
    std::size_t found = 0, apart = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        std::int32_t nearest = -1;
        double least = 0.3F * double{0.3F};
        const std::int32_t leaf = octree_leaf(positions[i], size);
        for (std::size_t j = 0; j < positions.size(); ++j) {
            const double squared = squared_distance(positions[i], positions[j]);
            if (j == i || !(squared < least))
                continue;
            if (leaf == no_leaf || octree_leaf(positions[j], size) != leaf) {
                ++apart;
                continue;
            }
            least = squared;
            nearest = static_cast<std::int32_t>(j);
        }
        CHECK(partners[i] == nearest);
        found += nearest >= 0 ? 1U : 0U;
    }
    CHECK(found > 500);
    CHECK(apart > 500);
}

TEST_CASE("octree pass: a hit answers as the listing does") {
    const Particles before = at_rest({{0.5F, 0.5F, 0.5F}, {0.6F, 0.5F, 0.5F}});
    FrameParams params = params_of_range(0.2F);
    params.constants.tick = 0.5F;
    Particles after;
    octree_pass(before, {}, params, Profile{}, after);
    CHECK(after.direction[0] == glm::vec3(-1.0F, 0.0F, 0.0F));
    CHECK(after.direction[1] == glm::vec3(1.0F, 0.0F, 0.0F));
    CHECK(after.speed[0] == 0.8F);
    CHECK(after.collide_time[0] == params.constants.collision_time);
    CHECK(after.position[0] == glm::vec3(0.5F - 0.8F * 0.5F, 0.5F, 0.5F));
}

TEST_CASE("octree pass: who does not search, or is out of reach, falls") {
    Particles before = at_rest({{0.5F, 0.5F, 0.5F}, {0.6F, 0.5F, 0.5F}, {0.9F, 0.5F, 0.5F}, {1.0F, 0.5F, 0.5F}});
    before.collide_time[0] = 0.0F;
    FrameParams params = params_of_range(0.2F);
    params.constants.tick = 0.5F;
    params.constants.gravity = {0.0F, -2.0F, 0.0F};
    Particles after;
    octree_pass(before, {}, params, Profile{}, after);
    CHECK(after.collide_time[1] == params.constants.collision_time);
    for (const std::size_t i : {0U, 2U, 3U}) { // 2 and 3 touch, but a side of their leaves lies between
        CAPTURE(i);
        CHECK(after.collide_time[i] == before.collide_time[i] - 0.5F);
        CHECK(after.speed[i] == 2.0F);
        CHECK(after.position[i] == before.position[i] - glm::vec3(0.0F, 1.0F, 0.0F));
    }
}

TEST_CASE("octree pass: a particle at the same place is skipped or hit, itself never") {
    const Particles before = at_rest({{0.5F, 0.5F, 0.5F}, {0.5F, 0.5F, 0.5F}, {0.8F, 0.8F, 0.8F}});
    FrameParams params = params_of_range(0.2F);
    Particles after;
    octree_pass(before, {}, params, Profile{}, after);
    CHECK(after.collide_time[0] < 0.0F);
    params.switches.zero_distance = ZeroDistance::hit;
    octree_pass(before, {}, params, Profile{}, after);
    CHECK(std::isnan(after.direction[0].x));
    CHECK(after.collide_time[1] > 0.0F);
    CHECK(after.collide_time[2] < 0.0F);
}

TEST_CASE("octree pass: of two as near the lower index counts") {
    const std::vector<glm::vec3> positions{{0.5F, 0.5F, 0.5F}, {0.6F, 0.5F, 0.5F}, {0.4F, 0.5F, 0.5F}};
    FrameParams params = params_of_range(0.2F);
    const float right = positions[1].x - positions[0].x;
    const std::vector<glm::vec3> even{positions[0], {0.5F + right, 0.5F, 0.5F}, {0.5F - right, 0.5F, 0.5F}};
    CHECK(octree_partners(even, {}, params, Profile{})[0] == 1);
}

TEST_CASE("octree pass: obstacles take part as their vertices, unless they are off") {
    const Particles before = at_rest({{0.5F, 0.5F, 0.5F}});
    Mesh obstacles;
    obstacles.positions = {{0.9F, 0.5F, 0.5F}, {0.5F, 0.4F, 0.5F}};
    FrameParams params = params_of_range(0.2F);
    CHECK(octree_partners(before.position, obstacles, params, Profile{})[0] == 2);
    Particles after;
    octree_pass(before, obstacles, params, Profile{}, after);
    CHECK(after.direction[0] == glm::vec3(0.0F, 1.0F, 0.0F));
    params.switches.obstacles_in_cdt = ObstaclesInCdt::off;
    CHECK(octree_partners(before.position, obstacles, params, Profile{})[0] == -1);
}

} // namespace lockstep::test::octree_pass_test
