#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace lockstep {

/// The upper one of the two in the middle where their number is even. Not of nothing.
double median(std::vector<double> values);

/// Slope of log time over log count by least squares: 1 is linear. Two counts or more, all above 0.
double fitted_exponent(std::span<const std::size_t> counts, std::span<const double> seconds);

/// The straight line a + b * count by least squares: how far a time is from it at most, as a fraction of the time. Two
/// counts or more.
double deviation_from_line(std::span<const std::size_t> counts, std::span<const double> seconds);

/// "12.3" of 0.123; "-" of NaN.
std::string percent(double part);

} // namespace lockstep
