#pragma once
#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "reference/model/clip_space.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// The fixed-function way from clip space to pixels (GL 4.5, 13.6 and 14.4), with what GL leaves open taken from
/// RasterRules. Sub-pixel positions are integers in units of 2^-subpixel_bits pixels, measured from the centre of
/// pixel 0: pixel k has its centre at k << subpixel_bits.

/// Pixels, upper bounds excluded.
struct PixelRect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// Window coordinates of a vertex: x, y in pixels, the depth as ClipDepth has it, and 1 / clip w.
struct WindowPosition {
    float x = 0.0F, y = 0.0F, z = 0.0F;
    float inverse_w = 0.0F;
};

/// Perspective divide and viewport transform for a viewport of width x height at the origin.
inline WindowPosition window_position(glm::vec4 clip, int width, int height, ViewportRounding rounding,
                                      const ClipDepth& depth = {}) {
    const float half_width = static_cast<float>(width) * 0.5F;
    const float half_height = static_cast<float>(height) * 0.5F;
    const float inverse_w = 1.0F / clip.w;
    const auto to_window = [&](float coordinate, float scale, float offset) {
        if (rounding == ViewportRounding::scaled)
            return (coordinate * scale) * inverse_w + offset;
        const float ndc = coordinate * inverse_w;
        return rounding == ViewportRounding::fused ? std::fma(ndc, scale, offset) : ndc * scale + offset;
    };
    return {to_window(clip.x, half_width, half_width), to_window(clip.y, half_height, half_height),
            to_window(clip.z, depth.scale(), depth.offset()), inverse_w};
}

/// The same for a point.
inline WindowPosition window_position(glm::vec4 clip, int width, int height, const RasterRules& rules,
                                      const ClipDepth& depth = {}) {
    return window_position(clip, width, height, rules.viewport, depth);
}

/// Sub-pixel position of a coordinate. Needs |window| < 2^20.
inline std::int32_t snap(float window, SnapRounding rounding, int subpixel_bits) {
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

/// The same for a point.
inline std::int32_t snap_point(float window, const RasterRules& rules) {
    return snap(window, rules.point_snap, rules.subpixel_bits);
}

/// The same for a triangle's corner.
inline std::int32_t snap_vertex(float window, const RasterRules& rules) {
    return snap(window, rules.vertex_snap, rules.subpixel_bits);
}

/// The pixel a size-1 point at a sub-pixel position covers along one axis.
inline int point_pixel(std::int32_t snapped, const RasterRules& rules) {
    // The unit square round the point covers the centres strictly inside it; one edge of the two counts as inside.
    const std::int32_t half = 1 << (rules.subpixel_bits - 1);
    return (snapped + half - (rules.point_edge_to_lower ? 1 : 0)) >> rules.subpixel_bits;
}

/// Whether a point's centre lies in the closed clip volume -w <= x, y, z <= w (GL 13.5), z as ClipDepth has it. False
/// for NaN, and for w = 0, subnormal or infinite, which have no place on the image. No short cuts, so that a loop over
/// points runs on vectors.
inline bool in_clip_volume(glm::vec4 clip, const ClipDepth& depth = {}) {
    constexpr float least = std::numeric_limits<float>::min(), most = std::numeric_limits<float>::max();
    return (clip.w >= least) & (clip.w <= most) & (std::abs(clip.x) <= clip.w) & (std::abs(clip.y) <= clip.w) &
           (clip.z >= depth.least(clip.w)) & (clip.z <= clip.w);
}

} // namespace lockstep
