#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace lockstep {

/// The upper one of the two in the middle where their number is even. Not of nothing.
double median(std::vector<double> values);

/// Slope of log time over log count by least squares: 1 is linear. Two counts or more, all above 0.
double fitted_exponent(std::span<const std::size_t> counts, std::span<const double> seconds);

} // namespace lockstep
