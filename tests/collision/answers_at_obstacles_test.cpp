#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "crosscheck/collision/study/answers_at_obstacles.hpp"
#include "crosscheck/collision/study/study.hpp"
#include "crosscheck/scene/surface.hpp"
#include "tests/random_positions.hpp"

namespace lockstep::test::answers_at_obstacles_test {

namespace {

/// A floor seen from above, and particles at these heights over it, far from one another.
Scene floor_scene(const std::vector<float>& heights) {
    Scene scene;
    scene.camera.eye = {0.0F, 2.0F, 2.0F};
    scene.width = scene.height = 400;
    place(plane_surface(2.0, 2.0), {}, scene.obstacles);
    scene.start.resize(heights.size());
    for (std::size_t i = 0; i < heights.size(); ++i)
        scene.start.set(i, {{-0.5F + 0.1F * static_cast<float>(i), heights[i], 0.05F}, {}, 0.0F, 0.0F});
    return scene;
}

std::vector<bool> hits_in_cdt(const Scene& scene) { return hits_of_cdt(study_start(scene, Profile{})); }

} // namespace

TEST_CASE("answers at obstacles: the distance to a triangle is that to its nearest point") {
    const glm::dvec3 a(0.0), b(2.0, 0.0, 0.0), c(0.0, 2.0, 0.0);
    CHECK(distance_to_triangle({0.5, 0.5, 3.0}, a, b, c) == 3.0);
    CHECK(distance_to_triangle({0.5, 0.5, -3.0}, c, b, a) == 3.0);
    CHECK(distance_to_triangle({1.0, -2.0, 0.0}, a, b, c) == 2.0);
    CHECK(distance_to_triangle({5.0, 0.0, 4.0}, a, b, c) == 5.0);
    CHECK(distance_to_triangle({2.0, 2.0, 0.0}, a, b, c) == Approx(std::sqrt(2.0)));
    CHECK(distance_to_triangle({1.0, 1.0, 1.0}, a, a, b) == Approx(std::sqrt(2.0)));
    CHECK(distance_to_triangle({3.0, 4.0, 0.0}, a, a, a) == 5.0);
}

TEST_CASE("answers at obstacles: who touches is told as every triangle tells it by itself") {
    Mesh mesh;
    for (const glm::vec3 position : test::random_positions(90, 1.0F, 7))
        mesh.positions.push_back(position);
    for (std::uint32_t i = 0; i < 90; ++i)
        mesh.indices.push_back(i);
    std::vector<glm::vec3> positions = test::random_positions(400, 1.0F, 11);
    positions[3].y = std::numeric_limits<float>::quiet_NaN();
    positions[4].x = std::numeric_limits<float>::infinity();
    std::vector<std::size_t> expected;
    for (std::size_t i = 0; i < positions.size(); ++i)
        for (std::size_t t = 0; t < 30; ++t)
            if (distance_to_triangle(positions[i], mesh.positions[3 * t], mesh.positions[3 * t + 1],
                                     mesh.positions[3 * t + 2]) < double{0.02F}) {
                expected.push_back(i);
                break;
            }
    CHECK(expected.size() > 20);
    CHECK(expected.size() < 390);
    CHECK(touching(positions, mesh, 0.02F) == expected);
    CHECK(touching(positions, {}, 0.02F).empty());
}

TEST_CASE("answers at obstacles: depth answers behind a surface alone, the image on both sides, leaves at a vertex") {
    const Scene scene = floor_scene({0.003F, -0.003F, 0.5F, -0.5F});
    const auto at = touching(scene.start.position, scene.obstacles, scene.constants.collision_range);
    CHECK(at == std::vector<std::size_t>{0, 1});
    CHECK(hits_of_depth(scene, Profile{}) == std::vector{false, true, false, false});
    CHECK(hits_in_cdt(scene) == std::vector{true, true, false, false});
    CHECK(hits_of_octree(scene) == std::vector{false, false, false, false});
    CHECK(share_of_hits(hits_of_depth(scene, Profile{}), at) == 0.5);
    CHECK(std::isnan(share_of_hits({}, {})));

    Scene corner = scene;
    corner.start.position[2] = corner.obstacles.positions[0] + glm::vec3(0.001F);
    CHECK(hits_of_octree(corner) == std::vector{false, false, true, false});
    corner.switches.obstacles_in_cdt = ObstaclesInCdt::off;
    for (const auto& hits : {hits_of_octree(corner), hits_in_cdt(corner), hits_of_depth(corner, Profile{})})
        CHECK(hits == std::vector{false, false, false, false});
}

} // namespace lockstep::test::answers_at_obstacles_test
