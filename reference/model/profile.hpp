#pragma once
#include <string>

namespace lockstep {

/// How a driver was measured to compute what GL leaves open (spec, "What was measured of drivers").
/// Plain data: `lockstep probe` fills it, the reference follows it. `strict` is the reference on its own terms.

/// Order of the sums in dot, length and normalize.
enum class DotOrder {
    left_to_right, ///< (x + y) + z
    right_to_left, ///< x + (y + z)
    fused_chain,   ///< fma(z, z', fma(y, y', x * x'))
};

/// How a position becomes window coordinates after the projection.
enum class ViewportRounding {
    separate, ///< ((clip * (1 / w)) * scale) + offset, each operation rounded
    fused,    ///< fma(clip * (1 / w), scale, offset)
};

/// Fixed-function rasterisation: GL leaves snap and ties open (gl-rules, 3c).
struct RasterRules {
    int subpixel_bits = 8;
    ViewportRounding viewport = ViewportRounding::separate;
    bool point_edge_to_lower = true;   ///< a point on a pixel edge belongs to the lower pixel, in x and in y
    bool triangle_bottom_edge = false; ///< horizontal edge ties: false: the pixel row above a lower edge is in
};

struct Profile {
    std::string name = "strict";
    DotOrder dot = DotOrder::left_to_right;
    bool flush_subnormals = true; ///< subnormal operands and results are zero
    RasterRules raster;
};

} // namespace lockstep
