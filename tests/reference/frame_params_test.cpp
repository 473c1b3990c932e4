#include <catch2/catch.hpp>

#include "reference/collision/collision_pass.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep::test::frame_params_test {

namespace {

/// 90 degrees from z = 3: a point at (1, 0, 0) stands at ndc 1/3.
Scene scene() {
    Scene s;
    s.camera = {.eye = {0.0F, 0.0F, 3.0F}, .target = glm::vec3(0.0F), .fov_y = 90.0F};
    s.collision_camera = s.camera;
    s.collision_camera.eye.z = 7.0F;
    return s;
}

int texel_of_unit_x(const Scene& s, int frame = 0) {
    return base_texel({1.0F, 0.0F, 0.0F}, frame_params(s, frame), {}).x;
}

} // namespace

TEST_CASE("frame: sizes, constants, switches and box are the scene's") {
    Scene s = scene();
    s.width = 40;
    s.height = 30;
    s.render_width = 20;
    s.render_height = 10;
    s.cdt_box = {glm::vec3(2.0F), glm::vec3(3.0F)};
    s.constants.tick = 0.25F;
    s.switches = preset("paper");
    const FrameParams params = frame_params(s, 0);
    CHECK((params.width == 40 && params.height == 30));
    CHECK((params.render_width == 20 && params.render_height == 10));
    CHECK(params.cdt_box.max == glm::vec3(3.0F));
    CHECK(params.constants.tick == 0.25F);
    CHECK(params.switches == s.switches);
    CHECK(params.collision_proj_view == view_projection_matrix(s.camera, 40.0F / 30.0F));
    CHECK(params.render_projection == projection_matrix(s.camera, 2.0F));
    CHECK(params.render_view == view_matrix(s.camera));
}

TEST_CASE("frame: switch cdt_camera: the render camera, with a z offset, or a camera of its own") {
    Scene s = scene();
    CHECK(texel_of_unit_x(s) == 333); // (1/3 + 1) * 250
    s.switches.cdt_camera_offset = 1.0F;
    CHECK(texel_of_unit_x(s) == 312); // (1/4 + 1) * 250
    CHECK(frame_params(s, 0).render_view == view_matrix(s.camera));
    s.switches.cdt_camera = CdtCamera::fixed;
    CHECK(texel_of_unit_x(s) == 285); // (1/7 + 1) * 250; the offset belongs to a moving camera
}

TEST_CASE("frame: the offset moves the collision camera without turning it") {
    Scene s = scene();
    s.camera.eye = {3.0F, 0.0F, 0.0F}; // looks along -x, with -z to its right
    s.switches.cdt_camera_offset = 0.5F;
    const auto texel_of_z = [&](float z) { return base_texel({0.0F, 0.0F, z}, frame_params(s, 0), {}).x; };
    CHECK(texel_of_z(0.5F - 0.003F) == 250);
    CHECK(texel_of_z(0.5F + 0.003F) == 249);
}

TEST_CASE("frame: a moving collision camera follows the path, a fixed one stays") {
    Scene s = scene();
    s.camera_path = {{0, {0.0F, 0.0F, 3.0F}, glm::vec3(0.0F)}, {4, {0.0F, 0.0F, 7.0F}, glm::vec3(0.0F)}};
    CHECK(texel_of_unit_x(s, 0) == 333);
    CHECK(texel_of_unit_x(s, 4) == 285);
    CHECK(texel_of_unit_x(s, 1) == 312);
    s.switches.cdt_camera = CdtCamera::fixed;
    s.collision_camera.eye.z = 4.0F;
    CHECK(texel_of_unit_x(s, 4) == 312);
    CHECK(frame_params(s, 4).render_view[3].z == -7.0F);
}

} // namespace lockstep::test::frame_params_test
