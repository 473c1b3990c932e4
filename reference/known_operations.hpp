#pragma once
#include "reference/model/profile.hpp"

namespace lockstep {

/// What of fixed-function rasterisation has one answer only, the reference's. Of the rest it is known that GL's rules
/// hold (4.5, 2.3.4.1, 13.6, 14.4, 14.6): window coordinates are right to 1 part in 10^5, then on a grid of at least
/// 4 sub-pixel bits, and what lies on a pixel's edge may belong to either side.
struct KnownRaster {
    bool point_window = false; ///< a point's perspective divide and viewport transform
    bool point_grid = false;   ///< its sub-pixel bits, and how it is put on that grid
    bool point_edges = false;  ///< who owns a point on a pixel's edge
    bool point_depth = false;
    bool triangle_window = false; ///< the same of a triangle's corners
    bool triangle_grid = false;
    bool triangle_sides = false; ///< whether a centre on a side is covered
    bool equal_depth = true;     ///< of equally deep ones the first stays: GL's own rule for LESS (17.3.4)
    /// Corners and points are on a grid of at least 4 sub-pixel bits, as GL asks; false of a driver measured on none.
    bool gl_grid = true;
    /// Where the rounding of window coordinates is not known: that they err by no more than glsl_window_accuracy.
    bool point_window_accurate = false;
    bool corner_window_accurate = false;

    bool operator==(const KnownRaster&) const = default;
    static constexpr KnownRaster all() { return {true, true, true, true, true, true, true, true, true}; }
    [[nodiscard]] bool triangles() const { return triangle_window && triangle_grid && triangle_sides; }
    [[nodiscard]] bool points() const {
        return point_window && point_grid && point_edges && point_depth && equal_depth;
    }
};

/// The operations known to give one answer only, the one the reference computes with its profile. Of the others it is
/// known that GLSL's precision rules hold. As it stands: what GLSL alone says of shaders whose results are `precise`.
struct KnownOperations {
    bool sums = true; ///< + - *: each rounded to nearest, in the order written. `precise` promises it
    bool divide = false;
    bool square_root = false; ///< and length, of a dot product that is known
    bool dot = false;         ///< its order and fusing, to those of the profile
    bool normalize = false;
    bool subnormals = false;        ///< whether they are flushed
    bool points = false;            ///< where a point lands, what a triangle covers, and how deep: all of it
    KnownRaster raster = {};        ///< and its parts
    bool interpolation = false;     ///< + - * / in the fragment stage, of a triangle's corners
    DriverConverts converts = {};   ///< what is stored as the driver rounds it
    bool factors_reordered = false; ///< a product of products may be taken in another order, in spite of `precise`

    bool operator==(const KnownOperations&) const = default;
    static constexpr KnownOperations all() {
        return {true, true, true, true, true, true, true, KnownRaster::all(), true};
    }
};

/// What was measured of the driver behind `profile`. A row of the probe that the reference does not follow takes away
/// what it is about, and nothing else; a row that is not known by name here takes away everything.
KnownOperations measured_operations(const Profile& profile);

/// What of `known` holds in the fragment stage, of which the probe measures division and `a * b + c` alone.
KnownOperations in_fragment_stage(KnownOperations known);

/// What of `known` holds in the compute stage, where the probe found that it computes otherwise than the vertex stage.
KnownOperations in_compute_stage(KnownOperations known, const Profile& profile);

} // namespace lockstep
