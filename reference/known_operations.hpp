#pragma once
#include "reference/model/profile.hpp"

namespace lockstep {

/// The operations known to give one answer only, the one the reference computes with its profile. Of the others it is
/// known that GL's precision rules hold. As it stands: what GLSL alone says of shaders whose results are `precise`.
struct KnownOperations {
    bool sums = true; ///< + - *: each rounded to nearest, in the order written. `precise` promises it
    bool divide = false;
    bool square_root = false;
    bool dot = false; ///< its order and fusing
    bool normalize = false;
    bool subnormals = false; ///< whether they are flushed
    bool points = false;     ///< where a point lands, what a triangle covers, and how deep
};

/// What was measured of the driver behind `profile`.
KnownOperations measured_operations(const Profile& profile);

} // namespace lockstep
