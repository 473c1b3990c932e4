#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "reference/model/profile.hpp"
#include "reference/numbers.hpp"
#include "reference/pixel_box.hpp"
#include "reference/window.hpp"

namespace lockstep {

/// A particle as a camera-facing square: its opposite corners in clip space. Both have the z and w of `low`, so the
/// square is a rectangle along the axes of the window too.
template <class Vec4> struct BillboardOf {
    Vec4 low{};
    Vec4 high{};
};
using Billboard = BillboardOf<glm::vec4>;

/// The square of half side `radius` round `centre` (view space), parallel to the image.
template <class A> BillboardOf<typename NumbersOf<A>::Vec4>
expand_billboard(A fp, const typename NumbersOf<A>::Vec3& centre, float radius, const glm::mat4& projection) {
    return {fp.transform(projection, {centre.x - radius, centre.y - radius, centre.z}),
            fp.transform(projection, {centre.x + radius, centre.y + radius, centre.z})};
}

/// Whether any of it can be seen: in front of the camera, between near and far plane, not beside the image. False for
/// NaN. The geometry shader emits nothing otherwise.
template <class Vec4> auto is_visible(const BillboardOf<Vec4>& b) {
    const auto w = b.low.w;
    return (w > 0.0F) & (abs(b.low.z) <= w) & (b.low.x <= w) & (b.low.y <= w) & (b.high.x >= -w) & (b.high.y >= -w);
}

/// The pixels of a visible billboard, as its two triangles cover them: half open, by the fill rule.
inline PixelRect covered_pixels(const Billboard& b, int width, int height, const RasterRules& rules) {
    const float w = b.low.w;
    const auto clamped = [&](float x, float y) {
        return window_position({std::clamp(x, -w, w), std::clamp(y, -w, w), b.low.z, w}, width, height,
                               rules.vertex_viewport);
    };
    const WindowPosition low = clamped(b.low.x, b.low.y);
    const WindowPosition high = clamped(b.high.x, b.high.y);
    // The first pixel whose centre lies beyond an edge, or on it where the lower edge owns its points.
    const auto first = [&](float edge, bool owned) {
        const std::int32_t snapped = snap_vertex(edge, rules);
        return (snapped + (owned ? (1 << rules.subpixel_bits) - 1 : 1 << rules.subpixel_bits)) >> rules.subpixel_bits;
    };
    return {std::max(0, first(low.x, rules.left_edge_in)), std::max(0, first(low.y, rules.lower_edge_in)),
            std::min(width, first(high.x, rules.left_edge_in)), std::min(height, first(high.y, rules.lower_edge_in))};
}

/// The window rectangle as the fragment shader sees it, pixels: not snapped.
template <class Vec2> struct BillboardWindowOf {
    Vec2 low{};
    Vec2 high{};
    Vec2 centre{};
    Vec2 half{};
};
using BillboardWindow = BillboardWindowOf<glm::vec2>;

template <class A> BillboardWindowOf<typename NumbersOf<A>::Vec2>
billboard_window(A fp, const BillboardOf<typename NumbersOf<A>::Vec4>& b, int width, int height) {
    const auto low = window_place(fp, {b.low.x, b.low.y}, b.low.w, width, height);
    const auto high = window_place(fp, {b.high.x, b.high.y}, b.low.w, width, height);
    return {low, high, (low + high) * 0.5F, (high - low) * 0.5F};
}

} // namespace lockstep
