#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "reference/model/profile.hpp"
#include "reference/pixel_box.hpp"
#include "reference/window.hpp"

namespace lockstep {

/// A particle as a camera-facing square: its opposite corners in clip space. Both have the z and w of `low`, so the
/// square is a rectangle along the axes of the window too.
struct Billboard {
    glm::vec4 low{0.0F};
    glm::vec4 high{0.0F};
};

/// The square of half side `radius` round `centre` (view space), parallel to the image.
template <class A> Billboard expand_billboard(A fp, glm::vec3 centre, float radius, const glm::mat4& projection) {
    return {fp.transform(projection, {centre.x - radius, centre.y - radius, centre.z}),
            fp.transform(projection, {centre.x + radius, centre.y + radius, centre.z})};
}

/// Whether any of it can be seen: in front of the camera, between near and far plane, not beside the image. False for
/// NaN. The geometry shader emits nothing otherwise.
inline bool is_visible(const Billboard& b) {
    const float w = b.low.w;
    return w > 0.0F && std::abs(b.low.z) <= w && b.low.x <= w && b.low.y <= w && b.high.x >= -w && b.high.y >= -w;
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
struct BillboardWindow {
    glm::vec2 low{0.0F};
    glm::vec2 high{0.0F};
    glm::vec2 centre{0.0F};
    glm::vec2 half{0.0F};
};

template <class A> BillboardWindow billboard_window(A fp, const Billboard& b, int width, int height) {
    const glm::vec2 low = window_place(fp, glm::vec2(b.low), b.low.w, width, height);
    const glm::vec2 high = window_place(fp, glm::vec2(b.high), b.low.w, width, height);
    return {low, high, (low + high) * 0.5F, (high - low) * 0.5F};
}

} // namespace lockstep
