#pragma once
#include <array>
#include <string>

#include "gpu/probe/driver_arithmetic.hpp"
#include "gpu/probe/judge.hpp"

namespace lockstep::probing {

/// Those in the texts of shaders/probe/arithmetic.vert and arithmetic.comp: that of a dust seed, a third, a colour's
/// code, that of a dust ray.
inline constexpr std::array<float, 4> constant_divisors{79238.288F, 3.0F, 255.0F, 82801.277F};

/// Whether `values`, what a stage made of dividends by these constants, four each, are quotients as by any number, or
/// products with the constants' reciprocals.
ProbeRow judge_constant_divisors(const std::string& name, const DriverArithmetic& vertex, const Floats& dividends,
                                 const Floats& values);

} // namespace lockstep::probing
