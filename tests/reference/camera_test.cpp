#include <catch2/catch.hpp>

#include <cmath>

#include "reference/model/camera.hpp"

namespace lockstep::test::camera_test {

namespace {

/// Looks along -z from z = 3; 90 degrees, so that half the view's height equals the distance.
Camera square_on() {
    return {
        .eye = {0.0F, 0.0F, 3.0F}, .target = glm::vec3(0.0F), .fov_y = 90.0F, .near_plane = 1.0F, .far_plane = 5.0F};
}

glm::vec3 ndc(const Camera& camera, float aspect, glm::vec3 p) {
    const glm::vec4 clip = view_projection_matrix(camera, aspect) * glm::vec4(p, 1.0F);
    return glm::vec3(clip) / clip.w;
}

void check_near(glm::vec3 a, glm::vec3 b) {
    for (int axis = 0; axis < 3; ++axis)
        CHECK(a[axis] == Approx(b[axis]).margin(1e-6));
}

} // namespace

TEST_CASE("camera: the view looks along -z, x right and y up") {
    const glm::mat4 view = view_matrix(square_on());
    CHECK(view * glm::vec4(1.0F, 2.0F, -1.0F, 1.0F) == glm::vec4(1.0F, 2.0F, -4.0F, 1.0F));
    Camera side = square_on();
    side.eye = {4.0F, 0.0F, 0.0F}; // looks along -x: right is -z
    check_near(glm::vec3(view_matrix(side) * glm::vec4(1.0F, 2.0F, -1.0F, 1.0F)), {1.0F, 2.0F, -3.0F});
}

TEST_CASE("camera: near and far plane and the edges of the view map to -1 and 1") {
    check_near(ndc(square_on(), 1.0F, {0.0F, 0.0F, 2.0F}), {0.0F, 0.0F, -1.0F});
    check_near(ndc(square_on(), 1.0F, {0.0F, 0.0F, -2.0F}), {0.0F, 0.0F, 1.0F});
    // At distance 3 the view is 3 high either way; depth (f + n) / (f - n) - 2 f n / ((f - n) d) = 6/4 - 10/12.
    check_near(ndc(square_on(), 1.0F, {3.0F, -1.5F, 0.0F}), {1.0F, -0.5F, 1.5F - 10.0F / 12.0F});
    check_near(ndc(square_on(), 2.0F, {3.0F, -1.5F, 0.0F}), {0.5F, -0.5F, 1.5F - 10.0F / 12.0F});
}

TEST_CASE("camera: the product of view and projection is rounded once") {
    Camera camera = square_on();
    camera.eye = {0.3F, 0.7F, 2.9F};
    camera.fov_y = 43.0F;
    const glm::mat4 whole = view_projection_matrix(camera, 1.3F);
    const glm::mat4 product = projection_matrix(camera, 1.3F) * view_matrix(camera);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            CHECK(whole[column][row] == Approx(product[column][row]).margin(1e-5));
}

TEST_CASE("camera: no path leaves the camera, a path moves eye and target between its keys and holds at its ends") {
    const Camera camera = square_on();
    CHECK(camera_at(camera, {}, 7).eye == camera.eye);
    const std::vector<CameraKey> keys{{10, {0.0F, 0.0F, 4.0F}, {0.0F, 0.0F, 0.0F}},
                                      {14, {2.0F, 0.0F, 4.0F}, {0.0F, 1.0F, 0.0F}},
                                      {16, {2.0F, 0.0F, 8.0F}, {0.0F, 1.0F, 0.0F}}};
    CHECK(camera_at(camera, keys, 0).eye == keys[0].eye);
    CHECK(camera_at(camera, keys, 10).eye == keys[0].eye);
    CHECK(camera_at(camera, keys, 11).eye == glm::vec3(0.5F, 0.0F, 4.0F));
    CHECK(camera_at(camera, keys, 11).target == glm::vec3(0.0F, 0.25F, 0.0F));
    CHECK(camera_at(camera, keys, 14).eye == keys[1].eye);
    CHECK(camera_at(camera, keys, 15).eye == glm::vec3(2.0F, 0.0F, 6.0F));
    CHECK(camera_at(camera, keys, 99).eye == keys[2].eye);
    CHECK(camera_at(camera, keys, 99).fov_y == camera.fov_y);
}

TEST_CASE("camera: two keys of one frame are a jump") {
    const std::vector<CameraKey> keys{{0, glm::vec3(0.0F), glm::vec3(0.0F)},
                                      {5, glm::vec3(1.0F), glm::vec3(0.0F)},
                                      {5, glm::vec3(3.0F), glm::vec3(0.0F)}};
    CHECK(camera_at({}, keys, 4).eye.x == 0.8F);
    CHECK(camera_at({}, keys, 5).eye.x == 3.0F);
}

} // namespace lockstep::test::camera_test
