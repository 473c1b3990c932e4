#include "crosscheck/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double fitted_exponent(std::span<const std::size_t> counts, std::span<const double> seconds) {
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double u = std::log(static_cast<double>(counts[i]));
        const double v = std::log(seconds[i]);
        n += 1.0;
        x += u;
        y += v;
        xx += u * u;
        xy += u * v;
    }
    return (n * xy - x * y) / (n * xx - x * x);
}

} // namespace lockstep
