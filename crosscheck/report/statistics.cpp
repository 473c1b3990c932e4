#include "crosscheck/report/statistics.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace lockstep {

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

namespace {

struct FittedLine {
    double start, slope;
};

FittedLine fitted_line(std::span<const double> x, std::span<const double> y) {
    double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        sx += x[i];
        sy += y[i];
        sxx += x[i] * x[i];
        sxy += x[i] * y[i];
    }
    const auto n = static_cast<double>(x.size());
    const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    return {(sy - slope * sx) / n, slope};
}

} // namespace

double fitted_exponent(std::span<const std::size_t> counts, std::span<const double> seconds) {
    std::vector<double> x, y;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        x.push_back(std::log(static_cast<double>(counts[i])));
        y.push_back(std::log(seconds[i]));
    }
    return fitted_line(x, y).slope;
}

double deviation_from_line(std::span<const std::size_t> counts, std::span<const double> seconds) {
    const std::vector<double> x(counts.begin(), counts.end());
    const FittedLine line = fitted_line(x, seconds);
    double largest = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
        largest = std::max(largest, std::abs(line.start + line.slope * x[i] - seconds[i]) / seconds[i]);
    return largest;
}

std::string percent(double part) { return std::isnan(part) ? "-" : fmt::format("{:.1f}", 100.0 * part); }

} // namespace lockstep
