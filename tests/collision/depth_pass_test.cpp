#include <catch2/catch.hpp>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>

#include "crosscheck/scene/surface.hpp"
#include "reference/collision/depth_pass.hpp"
#include "reference/collision/obstacle_pass.hpp"
#include "reference/collision/simulation.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/error.hpp"
#include "tests/collision/collision_scenes.hpp"

namespace lockstep::test::depth_pass_test {

namespace {

/// A camera that looks down on a floor at height 0, and nobody.
Scene floor_scene() {
    Scene scene;
    scene.camera.eye = {0.0F, 1.0F, 2.0F};
    scene.width = 120;
    scene.height = 100;
    scene.switches.search = Search::depth;
    scene.constants.collision_time = 0.01F;
    place(plane_surface(2.0, 2.0), {}, scene.obstacles);
    return scene;
}

void add(Scene& scene, glm::vec3 position, glm::vec3 direction, float speed) {
    const std::size_t i = scene.start.size();
    scene.start.resize(i + 1);
    scene.start.set(i, {position, direction, speed, -1.0F});
}

Particles run(const Scene& scene, int frames) {
    ReferenceSimulation simulation(scene, {});
    for (int frame = 0; frame < frames; ++frame)
        simulation.step(frame_params(scene, frame));
    return simulation.particles();
}

/// One particle after the frame in which the depth is there.
ParticleState answer(const Scene& scene, glm::vec3 position) {
    const FrameParams params = frame_params(scene, 1);
    CollisionImage image(params.width, params.height);
    DepthImage nearest(params.width, params.height, 1.0F);
    obstacle_pass(scene.obstacles, frame_params(scene, 0), {}, image, nearest);
    Particles one, after;
    one.resize(1);
    one.set(0, {position, {0.0F, -1.0F, 0.0F}, 0.5F, -1.0F});
    depth_pass(one, image, params, {}, after);
    return after[0];
}

/// How far a normal may turn where the depth of three texels is off by what a float near 1 and interpolation leave:
/// that along the ray, over the width of a texel.
double normal_bound(const Scene& scene, glm::vec3 position) {
    const glm::dmat4 m(frame_params(scene, 0).collision_proj_view);
    const double w = (m * glm::dvec4(position, 1.0)).w;
    const Camera& c = scene.camera;
    const double n = c.near_plane, f = c.far_plane;
    const double along = 0x1p-22 * w * w * (f - n) / (f * n);
    const double texel = 2.0 * w * std::tan(glm::radians(double{c.fov_y}) / 2.0) / scene.height;
    return 4.0 * along / texel;
}

} // namespace

TEST_CASE("depth pass: behind a surface by less than its thickness a particle leaves along the normal") {
    Scene scene = floor_scene();
    scene.constants.surface_thickness = 0.2F;
    const float thickness = scene.constants.surface_thickness, hit = scene.constants.collision_time;
    const glm::dmat4 m(frame_params(scene, 0).collision_proj_view);
    int hits = 0, deeper = 0;
    for (float x = -0.4F; x <= 0.4F; x += 0.1F)
        for (float y = 0.1F; y > -0.3F; y -= 0.007F) {
            const glm::vec3 at(x, y, 0.0F);
            const glm::dvec3 eye(scene.camera.eye), ray = glm::dvec3(at) - eye;
            const glm::dvec3 seen = eye + ray * (eye.y / (eye.y - double{y})); // where the floor hides it
            const double behind = (m * glm::dvec4(at, 1.0)).w - (m * glm::dvec4(seen, 1.0)).w;
            const double half_texel = 1.5 * glm::length(ray) / scene.height; // the texel's centre is up to that far off
            const ParticleState after = answer(scene, at);
            INFO(x << ", " << y << ": " << behind);
            if (behind < -half_texel || behind > double{thickness} + half_texel)
                CHECK(after.collide_time != hit);
            deeper += behind > double{thickness} + half_texel;
            if (behind <= half_texel || behind >= double{thickness} - half_texel)
                continue;
            ++hits;
            CHECK(after.collide_time == hit);
            CHECK(glm::length(glm::dvec3(after.direction) - glm::dvec3(0.0, 1.0, 0.0)) < normal_bound(scene, at));
            CHECK(after.speed == 0.5F * scene.switches.speed_factor);
        }
    CHECK(hits > 20);
    CHECK(deeper > 100);
}

TEST_CASE("depth pass: where nothing is drawn, behind the camera and at the image's edge nobody hits") {
    Scene scene = floor_scene();
    const float hit = scene.constants.collision_time;
    CHECK(answer(scene, {0.0F, -0.01F, 0.0F}).collide_time == hit);
    CHECK(answer(scene, {0.0F, 5.0F, 0.0F}).collide_time != hit);
    CHECK(answer(scene, {0.0F, 1.0F, 4.0F}).collide_time != hit);
    scene.obstacles = {};
    CHECK(answer(scene, {0.0F, -0.01F, 0.0F}).collide_time != hit);
}

TEST_CASE("depth pass: a particle falls on a floor and stays; without the floor it falls on") {
    Scene scene = floor_scene();
    add(scene, {0.05F, 0.2F, 0.1F}, {0.0F, -1.0F, 0.0F}, 0.1F);
    scene.constants.gravity = {0.0F, -0.15F, 0.0F};
    scene.switches.speed_factor = 0.2F;
    const float thickness = scene.constants.surface_thickness;
    for (const int frames : {120, 300, 600}) {
        const glm::vec3 at = run(scene, frames).position[0];
        CHECK(at.y > -thickness);
        CHECK(at.y < 0.1F);
    }
    scene.switches.obstacles_in_cdt = ObstaclesInCdt::off;
    CHECK(run(scene, 600).position[0].y < -1.0F);
    scene.switches.obstacles_in_cdt = ObstaclesInCdt::triangles;
    scene.constants.surface_thickness = 1e-6F;
    CHECK(run(scene, 600).position[0].y < -1.0F);
}

TEST_CASE("depth pass: two particles pass through each other where the listing's collide") {
    Scene scene = floor_scene();
    scene.constants.gravity = {0.0F, 0.0F, 0.0F};
    scene.constants.collision_range = 0.05F;
    scene.constants.texel_collide_range = 4;
    add(scene, {-0.2F, 0.3F, 0.0F}, {1.0F, 0.0F, 0.0F}, 0.3F);
    add(scene, {0.2F, 0.3F, 0.0F}, {-1.0F, 0.0F, 0.0F}, 0.3F);
    const Particles through = run(scene, 90);
    CHECK(through.position[0].x > 0.2F);
    CHECK(through.position[1].x < -0.2F);
    CHECK(through.speed[0] == through.speed[1]);
    scene.switches.search = Search::cdt;
    const Particles apart = run(scene, 90);
    CHECK(apart.position[0].x < 0.0F);
    CHECK(apart.position[1].x > 0.0F);
    CHECK(apart.speed[0] < 0.3F);
}

TEST_CASE("depth pass: while the camera moves, the depth is read with the matrix that it was drawn with") {
    Scene scene = floor_scene();
    add(scene, {0.05F, 0.1F, 0.1F}, {0.0F, -1.0F, 0.0F}, 0.1F);
    scene.switches.speed_factor = 0.2F;
    Camera there = scene.camera;
    there.eye = {0.6F, 1.6F, 1.4F};
    scene.camera_path = {{0, scene.camera.eye, scene.camera.target}, {240, there.eye, there.target}};
    const FrameParams now = frame_params(scene, 60);
    CHECK(now.earlier_proj_view == frame_params(scene, 59).collision_proj_view);
    CHECK(now.earlier_proj_view != now.collision_proj_view);
    CHECK(frame_params(scene, 0).earlier_proj_view == frame_params(scene, 0).collision_proj_view);
    const float y = run(scene, 240).position[0].y;
    CHECK(y > -scene.constants.surface_thickness);
    CHECK(y < 0.1F);
}

TEST_CASE("depth pass: switches that it does not know are told") {
    for (const auto& [name, value] : std::vector<std::pair<const char*, const char*>>{{"perspective_divide", "off"},
                                                                                      {"base_texel", "truncate"},
                                                                                      {"cdt_format", "rgba16f"},
                                                                                      {"obstacles_in_cdt", "vertices"},
                                                                                      {"step", "compute"},
                                                                                      {"velocity", "vector"},
                                                                                      {"not_searching", "stands"},
                                                                                      {"cdt_layers", "2"}}) {
        Switches switches;
        switches.search = Search::depth;
        CHECK_NOTHROW(check_switches(switches));
        set_switch(switches, name, value);
        INFO(name);
        CHECK_THROWS_WITH(check_switches(switches), Catch::Contains("search") && Catch::StartsWith("switch "));
    }
}

} // namespace lockstep::test::depth_pass_test
