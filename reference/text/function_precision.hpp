#pragma once
#include <GLSL.std.450.h>

#include "reference/interval.hpp"

namespace lockstep::text {

/// What a built-in function may give whose precision GLSL states (GLSL 4.60, 4.7.1: exp, exp2, log, log2, pow) or
/// leaves undefined (trigonometry and the hyperbolic functions: the Vulkan specification's "Precision and Operation of
/// SPIR-V Instructions" is taken, which drivers of both keep), of operands that may be any of a set. The set holds no
/// more than floats; anything where an operand may have no result.
Interval legal_function(GLSLstd450 function, Interval x);
/// The same of atan(y, x) and pow(x, y).
Interval legal_function(GLSLstd450 function, Interval x, Interval y);

} // namespace lockstep::text
