#pragma once
#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "reference/model/profile.hpp"

namespace lockstep {

/// The fixed-function way from clip space to pixels (GL 4.5, 13.6 and 14.4), with what GL leaves open taken from
/// RasterRules. Sub-pixel positions are integers in units of 2^-subpixel_bits pixels, measured from the centre of
/// pixel 0: pixel k has its centre at k << subpixel_bits.

/// Pixels, upper bounds excluded.
struct PixelRect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// Window coordinates of a vertex: x, y in pixels, z in 0..1 (default depth range), and 1 / clip w.
struct WindowPosition {
    float x = 0.0F, y = 0.0F, z = 0.0F;
    float inverse_w = 0.0F;
};

/// Perspective divide and viewport transform for a viewport of width x height at the origin.
WindowPosition window_position(glm::vec4 clip, int width, int height, const RasterRules& rules);

/// Sub-pixel position of a point's coordinate. Needs |window| < 2^20.
std::int32_t snap_point(float window, const RasterRules& rules);

/// The same for a triangle's corner.
std::int32_t snap_vertex(float window, const RasterRules& rules);

/// The pixel a size-1 point at a sub-pixel position covers along one axis.
int point_pixel(std::int32_t snapped, const RasterRules& rules);

/// Whether a point's centre lies in the closed clip volume -w <= x, y, z <= w (GL 13.5). False for NaN, and for w = 0,
/// which has no place on the image.
bool in_clip_volume(glm::vec4 clip);

} // namespace lockstep
