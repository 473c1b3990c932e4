#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reference/model/root_tables.hpp"

namespace lockstep {

/// How a driver was measured to compute what GL leaves open (spec, "What was measured of drivers"), operation by
/// operation, with `precise`, as the shipped shaders are written, and in the stage that a pass uses: the vertex stage,
/// or for the octree pass the compute stage.
/// Plain data: `lockstep probe` fills it, the reference follows it. `strict` is the reference on its own terms.

/// Order of the sums in dot, length and normalize; x, y, z stand for the products.
enum class DotOrder {
    left_to_right,     ///< (x + y) + z
    right_to_left,     ///< x + (y + z)
    fused_chain,       ///< fma(z, fma(y, x))
    middle_last,       ///< (x + z) + y
    fused_from_z,      ///< fma(x, fma(y, z))
    fused_y_x_z,       ///< fma(z, fma(x, y))
    fused_y_z_x,       ///< fma(x, fma(z, y))
    sum_then_fused_z,  ///< fma(z, x + y)
    sum_then_fused_x,  ///< fma(x, y + z)
    fused_then_plus_z, ///< fma(y, x) + z
    x_plus_fused,      ///< x + fma(y, z)
};

/// As `lockstep probe` words them, in the order of DotOrder: "(x+y)+z".
std::span<const std::string_view> dot_order_names();

/// Orders of the same sums that were found without `precise`, where they are others. A shader that does not say
/// `precise` may get either.
struct OtherOrders {
    std::vector<DotOrder> dot, length, normalize;

    bool operator==(const OtherOrders&) const = default;
};

/// How a position becomes window coordinates after the projection.
enum class ViewportRounding {
    separate, ///< ((clip * (1 / w)) * scale) + offset, each operation rounded
    fused,    ///< fma(clip * (1 / w), scale, offset)
    scaled,   ///< ((clip * scale) * (1 / w)) + offset; NVIDIA's comes closest to this, but is not it
};

/// How a window coordinate is put on the sub-pixel grid.
enum class SnapRounding { half_to_even, half_away, half_up, down };

/// Fixed-function rasterisation: GL leaves snap and ties open (gl-rules, 3c).
struct RasterRules {
    int subpixel_bits = 8;
    SnapRounding point_snap = SnapRounding::half_away;
    SnapRounding vertex_snap = SnapRounding::half_to_even;  ///< corners of triangles
    ViewportRounding viewport = ViewportRounding::separate; ///< of points
    bool depth_by_driver_reciprocal = false; ///< a point's depth takes 1 / w from the shader's own division
    bool point_edge_to_lower = true;         ///< a point on a pixel edge belongs to the lower pixel, in x and in y
    bool left_edge_in = true;  ///< a pixel centre on a left side of a triangle is inside (else: on a right one)
    bool lower_edge_in = true; ///< the same for a horizontal lower side, y up (else: an upper one)
    ViewportRounding vertex_viewport = ViewportRounding::separate; ///< of corners of triangles

    bool operator==(const RasterRules&) const = default;
};

/// The sizes of points that a driver draws, pixels: one that a shader sets is clamped to them (GL 4.5, 14.4;
/// GL_POINT_SIZE_RANGE).
struct PointSizes {
    float smallest = 1.0F, largest = std::numeric_limits<float>::infinity();

    bool operator==(const PointSizes&) const = default;
};

/// The largest distance seen between a driver's operation and the reference's, ULP; 0: never another bit.
struct OperationErrors {
    std::int64_t divide = 0;
    std::int64_t reciprocal = 0;
    std::int64_t sqrt = 0;
    std::int64_t inverse_sqrt = 0;
    std::int64_t length = 0;
    std::int64_t normalize = 0;
    std::int64_t fragment_divide = 0; ///< in the fragment stage, which interpolates over triangles
    std::int64_t fragment_reciprocal = 0;
};

/// Fragment stages that store plain floats: the driver converts them to the CDT's format, to either of two neighbours
/// (GL 4.5, 2.3.5). The shipped ones round by themselves.
struct DriverConverts {
    bool particles = false;
    bool triangles = false; ///< of obstacles
    bool vertices = false;

    bool operator==(const DriverConverts&) const = default;
};

struct Profile {
    std::string name = "strict"; ///< a label; nothing follows from it
    DotOrder dot = DotOrder::left_to_right;
    std::optional<DotOrder> length_dot;    ///< the sum inside length; null: as dot
    std::optional<DotOrder> normalize_dot; ///< the sum inside normalize; null: as dot
    OtherOrders other_orders;
    bool normalize_divides = false;            ///< by sqrt(dot); else it multiplies by inversesqrt(dot)
    bool flush_subnormals = true;              ///< subnormal operands and results are zero
    bool compute_flush_subnormals = true;      ///< subnormal operands are zero in compute shaders
    std::optional<bool> compute_flush_results; ///< subnormal results there; null: as operands
    RasterRules raster;
    PointSizes point_sizes;
    /// Whether window coordinates were measured to err by no more than glsl_window_accuracy; null: nobody measured.
    std::optional<bool> point_window_accurate, corner_window_accurate;
    DriverConverts converts;
    /// A stage that runs says `precise` of nothing, and the driver then fuses: + - * / and roots may be taken in any
    /// order, and are held to GLSL's precision.
    bool any_order = false;
    /// The obstacles' vertex stage says neither `precise` nor `invariant` of gl_Position, and the driver then fuses:
    /// its sums may be taken in any order.
    bool open_corners = false;
    OperationErrors errors;
    /// The driver's own 1/x and inversesqrt, where division, square root and normalize were measured to be made of them
    /// (arithmetic DriverRoots); null: the reference rounds them correctly.
    std::shared_ptr<const RootTables> roots;
    /// Rows of the probe that found what the reference cannot follow, or that contradict others. It then does what
    /// comes closest, and what the row is about may be all that GL allows (known_operations.hpp).
    std::vector<std::string> not_followed;

    [[nodiscard]] DotOrder length_order() const { return length_dot.value_or(dot); }
    [[nodiscard]] DotOrder normalize_order() const { return normalize_dot.value_or(dot); }
    /// Whether the probe's row found what the reference follows.
    [[nodiscard]] bool follows(std::string_view row) const;
    /// Whether dot, length and normalize sum in one order.
    [[nodiscard]] bool one_order() const { return length_order() == dot && normalize_order() == dot; }
};

/// Whether two profiles compute alike: the same orders, rounding and rules, and errors in the same operations.
bool computes_alike(const Profile& a, const Profile& b);

/// strict, llvmpipe or nvidia, as measured (spec, last section). Throws Error naming them for any other name.
Profile named_profile(std::string_view name);

} // namespace lockstep
