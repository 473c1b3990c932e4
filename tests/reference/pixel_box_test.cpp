#include "reference/pixel_box.hpp"

#include <limits>

#include <catch2/catch.hpp>

#include "reference/portable.hpp"

namespace lockstep::test::pixel_box_test {
namespace {

bool same(PixelRect a, PixelRect b) { return a.x0 == b.x0 && a.y0 == b.y0 && a.x1 == b.x1 && a.y1 == b.y1; }

bool is_empty(PixelRect box) { return box.x0 >= box.x1 || box.y0 >= box.y1; }

/// Image of 8 x 8: a quarter of clip space is one pixel.
PixelRect box(glm::vec4 a, glm::vec4 b, glm::vec4 c) { return triangle_box(Portable(), {a, b, c}, 8, 8); }

} // namespace

TEST_CASE("pixel box: clip space fills the image", "[pixel_box]") {
    CHECK(window_place(Portable(), {-1, 0}, 1, 16, 8) == glm::vec2(0, 4));
    CHECK(window_place(Portable(), {2, -1}, 2, 16, 8) == glm::vec2(16, 2));
}

TEST_CASE("pixel box: pixels whose centres lie inside or just beside", "[pixel_box]") {
    CHECK(same(pixel_box({1, 2}, {3, 5}, 8, 8), {1, 2, 3, 5}));
    CHECK(same(pixel_box({1.5F, 2.5F}, {3.5F, 5.5F}, 8, 8), {1, 2, 4, 6}));
    CHECK(same(pixel_box({1.5625F, 2.5625F}, {3.4375F, 5.4375F}, 8, 8), {1, 2, 4, 6}));
    CHECK(same(pixel_box({1.57F, 2.57F}, {3.43F, 5.43F}, 8, 8), {2, 3, 3, 5}));
}

TEST_CASE("pixel box: none without a centre nearby, and none outside the image", "[pixel_box]") {
    const float infinity = std::numeric_limits<float>::infinity();
    CHECK(is_empty(pixel_box({1.6F, 0}, {2.4F, 8}, 8, 8)));
    CHECK(is_empty(pixel_box({-9, 0}, {-1, 8}, 8, 8)));
    CHECK(is_empty(pixel_box({0, 9}, {8, 20}, 8, 8)));
    CHECK(same(pixel_box({-9, 3}, {1e30F, infinity}, 8, 6), {0, 3, 8, 6}));
    CHECK(is_empty(pixel_box({-infinity, -infinity}, {-infinity, infinity}, 8, 8)));
}

TEST_CASE("pixel box: round a triangle, after the perspective divide", "[pixel_box]") {
    CHECK(same(box({-1, -1, 0, 1}, {1, -1, 0, 2}, {-0.75F, 0.75F, 0, 3}), {0, 0, 6, 5}));
}

TEST_CASE("pixel box: a triangle that reaches behind the camera may cover all pixels, one behind it none",
          "[pixel_box]") {
    CHECK(same(box({0, 0, 0, 1}, {0.25F, 0, 0, 1}, {0, 0, 0, -1}), {0, 0, 8, 8}));
    CHECK(same(box({0, 0, 0, 1}, {0.25F, 0, 0, 1}, {0, 0, 0, 0}), {0, 0, 8, 8}));
    CHECK(is_empty(box({0, 0, 0, 0}, {1, 0, 0, -1}, {0, 1, 0, -1})));
}

TEST_CASE("pixel box: none for a triangle that is not finite", "[pixel_box]") {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
        for (int component = 0; component < 4; ++component) {
            glm::vec4 corner(0, 0, 0, 1);
            corner[component] = bad;
            CHECK(is_empty(box({-1, -1, 0, 1}, corner, {1, 1, 0, 1})));
        }
}

} // namespace lockstep::test::pixel_box_test
