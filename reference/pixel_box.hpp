#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "reference/numbers.hpp"
#include "reference/window.hpp"

namespace lockstep {

/// The rectangles of whole pixels that the exact preset draws in place of triangles and billboards, whose fragments
/// then decide by themselves what is covered. Twin of shaders/pixel_box.glsl and shaders/whole_triangle.glsl.

/// Where clip space lies on the image, pixels. Not snapped.
template <class A> typename NumbersOf<A>::Vec2 window_place(A fp, const typename NumbersOf<A>::Vec2& clip,
                                                            const typename NumbersOf<A>::Real& w, int width,
                                                            int height) {
    return {(fp.divide(clip.x, w) + 1.0F) * 0.5F * static_cast<float>(width),
            (fp.divide(clip.y, w) + 1.0F) * 0.5F * static_cast<float>(height)};
}

/// The pixels of an image of width x height whose centres lie in the window rectangle low..high or less than 1/16 pixel
/// beside it, which is more than `window_place` and the edge functions can be off. Not for NaN.
inline PixelRect pixel_box(glm::vec2 low, glm::vec2 high, int width, int height) {
    const auto clamped = [](float pixel, int size) {
        return static_cast<int>(std::clamp(pixel, 0.0F, static_cast<float>(size)));
    };
    return {clamped(std::ceil(low.x - 0.5625F), width), clamped(std::ceil(low.y - 0.5625F), height),
            clamped(std::floor(high.x - 0.4375F) + 1.0F, width), clamped(std::floor(high.y - 0.4375F) + 1.0F, height)};
}

/// The pixels a triangle may cover: all, if a part of it lies behind the camera; none, if a corner is not finite.
template <class A> PixelRect triangle_box(A fp, const std::array<glm::vec4, 3>& clip, int width, int height) {
    const auto finite = [](glm::vec4 v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
    };
    if (!std::all_of(clip.begin(), clip.end(), finite))
        return {};
    const auto [least_w, greatest_w] = std::minmax({clip[0].w, clip[1].w, clip[2].w});
    if (greatest_w <= 0.0F)
        return {};
    if (least_w <= 0.0F)
        return {0, 0, width, height};
    const auto place = [&](std::size_t i) { return window_place(fp, glm::vec2(clip[i]), clip[i].w, width, height); };
    const glm::vec2 a = place(0), b = place(1), c = place(2);
    return pixel_box(glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c), width, height);
}

} // namespace lockstep
