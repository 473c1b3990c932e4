#include "reference/collision/billboard.hpp"

#include <limits>

#include <catch2/catch.hpp>
#include <glm/mat4x4.hpp>

#include "reference/arithmetic.hpp"
#include "reference/collision/render_pass.hpp"
#include "reference/model/camera.hpp"

namespace lockstep::test::billboard_test {
namespace {

/// Looks down -z, 90 degrees: clip x, y are view x, y and w is the distance; near 1, far 3.
glm::mat4 right_angle_projection() {
    Camera camera;
    camera.fov_y = 90.0F;
    camera.near_plane = 1.0F;
    camera.far_plane = 3.0F;
    return projection_matrix(camera, 1.0F);
}

Billboard square(glm::vec3 centre, float radius) {
    return expand_billboard(Strict(), centre, radius, right_angle_projection());
}

bool same(PixelRect a, PixelRect b) { return a.x0 == b.x0 && a.y0 == b.y0 && a.x1 == b.x1 && a.y1 == b.y1; }

} // namespace

TEST_CASE("billboard: a particle becomes a square parallel to the image", "[billboard]") {
    // Distance 2, half side 0.5: corners at x, y of 0.5 and 1.5. z: -(f + n) / (f - n) z - 2 f n / (f - n) = 4 - 3.
    const Billboard b = square({1.0F, 1.0F, -2.0F}, 0.5F);
    CHECK(b.low == glm::vec4(0.5F, 0.5F, 1.0F, 2.0F));
    CHECK(b.high == glm::vec4(1.5F, 1.5F, 1.0F, 2.0F));
}

TEST_CASE("billboard: its window rectangle has the projected centre and half sides", "[billboard]") {
    // 0.25 to 0.75 of the way from the middle to the border of an image of 16 x 8.
    const BillboardWindow window = billboard_window(Strict(), square({1.0F, 1.0F, -2.0F}, 0.5F), 16, 8);
    CHECK(window.centre == glm::vec2(12.0F, 6.0F));
    CHECK(window.half == glm::vec2(2.0F, 1.0F));
}

TEST_CASE("billboard: a square twice as far covers half the pixels a side", "[billboard]") {
    CHECK(same(covered_pixels(square({0, 0, -1}, 0.5F), 16, 16, {}), {4, 4, 12, 12}));
    CHECK(same(covered_pixels(square({0, 0, -2}, 0.5F), 16, 16, {}), {6, 6, 10, 10}));
}

TEST_CASE("billboard: pixel centres on its border belong to the left and lower sides", "[billboard]") {
    // At distance 1 in an image of 8 x 8 a pixel is 0.25 wide: the border lies on the centres 3.5 and 4.5.
    const Billboard b = square({0, 0, -1}, 0.125F);
    CHECK(same(covered_pixels(b, 8, 8, {}), {3, 3, 4, 4}));
    RasterRules rules;
    rules.left_edge_in = false;
    CHECK(same(covered_pixels(b, 8, 8, rules), {4, 3, 5, 4}));
    rules.lower_edge_in = false;
    CHECK(same(covered_pixels(b, 8, 8, rules), {4, 4, 5, 5}));
}

TEST_CASE("billboard: pixels beyond the image are cut off", "[billboard]") {
    CHECK(same(covered_pixels(square({-1, 1, -1}, 0.5F), 8, 8, {}), {0, 6, 2, 8}));
}

TEST_CASE("billboard: nothing beside the image, before the near plane, beyond the far plane or of NaN is visible",
          "[billboard]") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(is_visible(square({0, 0, -2}, 0.5F)));
    CHECK(is_visible(square({2.4F, 0, -2}, 0.5F)));
    CHECK_FALSE(is_visible(square({2.6F, 0, -2}, 0.5F)));
    CHECK_FALSE(is_visible(square({-2.6F, 0, -2}, 0.5F)));
    CHECK_FALSE(is_visible(square({0, 2.6F, -2}, 0.5F)));
    CHECK_FALSE(is_visible(square({0, -2.6F, -2}, 0.5F)));
    CHECK_FALSE(is_visible(square({0, 0, -0.9F}, 0.5F)));
    CHECK_FALSE(is_visible(square({0, 0, -3.1F}, 0.5F)));
    CHECK_FALSE(is_visible(square({0, 0, 2}, 0.5F)));
    CHECK_FALSE(is_visible(square({nan, 0, -2}, 0.5F)));
    CHECK_FALSE(is_visible(square({0, nan, -2}, 0.5F)));
    CHECK_FALSE(is_visible(square({0, 0, nan}, 0.5F)));
}

TEST_CASE("billboard: a particle's square is taken through the render camera", "[billboard]") {
    Camera camera;
    camera.eye = {5, 0, 0};
    camera.target = {0, 0, 0};
    FrameParams params;
    params.render_view = view_matrix(camera);
    params.render_projection = right_angle_projection();
    params.constants.billboard_radius = 0.25F;
    params.render_width = params.render_height = 1 << 20; // nothing is drawn: no image is made for it
    const Billboard b = particle_billboard({3, 0, 0}, params, Profile{});
    CHECK(b.low.w == 2.0F);
    CHECK(b.low.x == -0.25F);
    CHECK(b.high.y == 0.25F);
}

} // namespace lockstep::test::billboard_test
