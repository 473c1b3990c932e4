#pragma once
#include <string>
#include <string_view>

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
    bool point_edge_to_lower = true; ///< a point on a pixel edge belongs to the lower pixel, in x and in y
    bool left_edge_in = true;        ///< a pixel centre on a left side of a triangle is inside (else: on a right one)
    bool lower_edge_in = true;       ///< the same for a horizontal lower side, y up (else: an upper one)
};

struct Profile {
    std::string name = "strict";
    DotOrder dot = DotOrder::left_to_right;
    bool flush_subnormals = true; ///< subnormal operands and results are zero
    RasterRules raster;
};

/// strict, llvmpipe or nvidia, as measured (spec, last section). Throws Error naming them for any other name.
Profile named_profile(std::string_view name);

} // namespace lockstep
