#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "reference/window.hpp"

namespace lockstep::test::window_test {

namespace {

RasterRules rules(int subpixel_bits, bool edge_to_lower = true) {
    RasterRules r;
    r.subpixel_bits = subpixel_bits;
    r.point_edge_to_lower = edge_to_lower;
    return r;
}

int pixel(float window, const RasterRules& r) { return point_pixel(snap_point(window, r), r); }

} // namespace

TEST_CASE("window: clip space becomes pixels, depth 0 to 1, and the reciprocal of w") {
    // ndc (0.5, -0.25, 0.5): x = 0.5 * 100 + 100, y = -0.25 * 50 + 50, z = 0.5 * 0.5 + 0.5.
    const WindowPosition window = window_position({2.0F, -1.0F, 2.0F, 4.0F}, 200, 100, RasterRules{});
    CHECK(window.x == 150.0F);
    CHECK(window.y == 37.5F);
    CHECK(window.z == 0.75F);
    CHECK(window.inverse_w == 0.25F);
}

TEST_CASE("window: the divide multiplies by the rounded reciprocal") {
    // 1/41 rounds to 13094412 * 2^-29, 41 times that is 536870892 * 2^-29, which rounds to 1 - 2^-24; -41/41 is -1.
    CHECK(window_position({-41.0F, 0.0F, 0.0F, 41.0F}, 2, 2, RasterRules{}).x == 0x1p-24F);
}

TEST_CASE("window: the viewport rounds once or twice, as the profile says") {
    // ndc -(1 - 2^-24), half a width of 1.5: the product -(1.5 - 1.5 * 2^-24) rounds to -(1.5 - 2^-23).
    RasterRules r;
    const glm::vec4 clip{-0x1.fffffep-1F, 0.0F, 0.0F, 1.0F};
    CHECK(window_position(clip, 3, 3, r).x == 0x1p-23F);
    r.viewport = ViewportRounding::fused;
    CHECK(window_position(clip, 3, 3, r).x == 1.5F * 0x1p-24F);
}

TEST_CASE("window: points snap half a sub-pixel away from zero, vertices to even") {
    const RasterRules r = rules(8);
    const float unit = 1.0F / 256.0F;
    // Sub-pixel positions count from the centre of pixel 0, 0.5.
    CHECK(snap_point(0.5F, r) == 0);
    CHECK(snap_point(1.5F, r) == 256);
    CHECK(snap_point(0.5F + 0.5F * unit, r) == 1);
    CHECK(snap_point(0.5F - 0.5F * unit, r) == -1);
    CHECK(snap_point(0.5F + 0.25F * unit, r) == 0);
    CHECK(snap_point(0.5F + 1.5F * unit, r) == 2);
    CHECK(snap_point(0.5F + 2.5F * unit, r) == 3);
    CHECK(snap_vertex(0.5F + 0.5F * unit, r) == 0);
    CHECK(snap_vertex(0.5F - 0.5F * unit, r) == 0);
    CHECK(snap_vertex(0.5F + 1.5F * unit, r) == 2);
    CHECK(snap_vertex(0.5F + 2.5F * unit, r) == 2);
    CHECK(snap_vertex(0.5F - 1.5F * unit, r) == -2);
    CHECK(snap_point(0.5F + unit, rules(4)) == 0);
    CHECK(snap_point(0.5F + 8.0F * unit, rules(4)) == 1);
}

TEST_CASE("window: a profile may snap in other ways") {
    RasterRules r = rules(8);
    const float unit = 1.0F / 256.0F;
    const auto snapped = [&](SnapRounding rounding, float units) {
        r.point_snap = r.vertex_snap = rounding;
        CHECK(snap_point(0.5F + units * unit, r) == snap_vertex(0.5F + units * unit, r));
        return snap_point(0.5F + units * unit, r);
    };
    CHECK(snapped(SnapRounding::half_to_even, 2.5F) == 2);
    CHECK(snapped(SnapRounding::half_away, 2.5F) == 3);
    CHECK(snapped(SnapRounding::half_up, 2.5F) == 3);
    CHECK(snapped(SnapRounding::down, 2.5F) == 2);
    CHECK(snapped(SnapRounding::half_to_even, -1.5F) == -2);
    CHECK(snapped(SnapRounding::half_away, -1.5F) == -2);
    CHECK(snapped(SnapRounding::half_up, -1.5F) == -1);
    CHECK(snapped(SnapRounding::down, -1.5F) == -2);
    CHECK(snapped(SnapRounding::down, 0.75F) == 0);
    CHECK(snapped(SnapRounding::half_up, 0.75F) == 1);
}

TEST_CASE("window: a point on a pixel edge goes to the lower pixel, or to the upper where the profile says") {
    CHECK(pixel(5.0F, rules(8)) == 4);
    CHECK(pixel(5.0F, rules(8, false)) == 5);
    CHECK(pixel(0.0F, rules(8)) == -1);
    CHECK(pixel(0.0F, rules(8, false)) == 0);
    CHECK(pixel(5.5F, rules(8)) == 5);
    CHECK(pixel(5.5F, rules(8, false)) == 5);
}

TEST_CASE("window: what snaps onto an edge belongs to it") {
    // Within 1/512 of the edge at 5 for 8 bits, 1/32 for 4.
    CHECK(pixel(5.0F + 1.0F / 1024.0F, rules(8)) == 4);
    CHECK(pixel(5.0F + 3.0F / 1024.0F, rules(8)) == 5);
    CHECK(pixel(5.0F - 1.0F / 1024.0F, rules(8, false)) == 5);
    CHECK(pixel(5.0F - 3.0F / 1024.0F, rules(8, false)) == 4);
    CHECK(pixel(5.0F + 1.0F / 64.0F, rules(4)) == 4);
    CHECK(pixel(5.0F + 3.0F / 64.0F, rules(4)) == 5);
}

TEST_CASE("window: every sub-pixel position belongs to the pixel whose square holds it") {
    for (const bool lower : {true, false}) {
        const RasterRules r = rules(4, lower);
        for (std::int32_t snapped = -40; snapped <= 40; ++snapped) {
            const double window = snapped / 16.0 + 0.5;
            const int floored = static_cast<int>(std::floor(window));
            const bool on_edge = window == floored;
            INFO("snapped " << snapped << ", lower " << lower);
            CHECK(point_pixel(snapped, r) == (on_edge && lower ? floored - 1 : floored));
        }
    }
}

TEST_CASE("window: the clip volume is closed and holds no NaN") {
    CHECK(in_clip_volume({1.0F, -1.0F, 1.0F, 1.0F}));
    CHECK(in_clip_volume({0.0F, 0.0F, -2.0F, 2.0F}));
    const float above = std::nextafter(1.0F, 2.0F);
    for (int axis = 0; axis < 3; ++axis)
        for (const float outside : {above, -above, std::numeric_limits<float>::quiet_NaN()}) {
            glm::vec4 clip{0.0F, 0.0F, 0.0F, 1.0F};
            clip[axis] = outside;
            CHECK_FALSE(in_clip_volume(clip));
        }
    CHECK_FALSE(in_clip_volume({0.0F, 0.0F, 0.0F, -1.0F}));
    CHECK_FALSE(in_clip_volume(glm::vec4(0.0F)));
    CHECK(in_clip_volume({0.0F, 0.0F, 0.0F, std::numeric_limits<float>::min()}));
    CHECK_FALSE(in_clip_volume({0.0F, 0.0F, 0.0F, 0.5F * std::numeric_limits<float>::min()}));
    CHECK(in_clip_volume({0.0F, 0.0F, 0.0F, std::numeric_limits<float>::max()}));
    CHECK_FALSE(in_clip_volume({0.0F, 0.0F, 0.0F, std::numeric_limits<float>::infinity()}));
    CHECK_FALSE(in_clip_volume({0.0F, 0.0F, 0.0F, std::numeric_limits<float>::quiet_NaN()}));
}

} // namespace lockstep::test::window_test
