#include "reference/window.hpp"

#include <cmath>

namespace lockstep {
namespace {

float to_window(float clip, float inverse_w, float scale, float offset, const RasterRules& rules) {
    const float ndc = clip * inverse_w;
    return rules.viewport == ViewportRounding::fused ? std::fma(ndc, scale, offset) : ndc * scale + offset;
}

std::int32_t snap(float window, SnapRounding rounding, int subpixel_bits) {
    const float scaled = static_cast<float>(1 << subpixel_bits) * (window - 0.5F);
    switch (rounding) {
    case SnapRounding::half_to_even:
        return static_cast<std::int32_t>(std::nearbyint(scaled));
    case SnapRounding::half_away:
        return static_cast<std::int32_t>(scaled >= 0.0F ? scaled + 0.5F : scaled - 0.5F);
    case SnapRounding::half_up:
        return static_cast<std::int32_t>(std::floor(scaled + 0.5F));
    case SnapRounding::down:
        return static_cast<std::int32_t>(std::floor(scaled));
    }
    return 0;
}

} // namespace

WindowPosition window_position(glm::vec4 clip, int width, int height, const RasterRules& rules) {
    const float half_width = static_cast<float>(width) * 0.5F;
    const float half_height = static_cast<float>(height) * 0.5F;
    const float inverse_w = 1.0F / clip.w;
    return {to_window(clip.x, inverse_w, half_width, half_width, rules),
            to_window(clip.y, inverse_w, half_height, half_height, rules),
            to_window(clip.z, inverse_w, 0.5F, 0.5F, rules), inverse_w};
}

std::int32_t snap_point(float window, const RasterRules& rules) {
    return snap(window, rules.point_snap, rules.subpixel_bits);
}

std::int32_t snap_vertex(float window, const RasterRules& rules) {
    return snap(window, rules.vertex_snap, rules.subpixel_bits);
}

int point_pixel(std::int32_t snapped, const RasterRules& rules) {
    // The unit square round the point covers the centres strictly inside it; one edge of the two counts as inside.
    const std::int32_t half = 1 << (rules.subpixel_bits - 1);
    return rules.point_edge_to_lower ? (snapped + half - 1) >> rules.subpixel_bits
                                     : (snapped + half) >> rules.subpixel_bits;
}

bool in_clip_volume(glm::vec4 clip) {
    return clip.w > 0.0F && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w && std::abs(clip.z) <= clip.w;
}

} // namespace lockstep
