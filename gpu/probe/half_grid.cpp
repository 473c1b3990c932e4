#include "gpu/probe/half_grid.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep::probing {

float on_half_grid(float x, double (*round)(double)) {
    const int exponent = std::max(std::ilogb(x), -14);
    const double unit = std::ldexp(1.0, exponent - 10);
    return static_cast<float>(round(static_cast<double>(x) / unit) * unit);
}

double nearest_even(double x) { return std::nearbyint(x); }
double nearest_away(double x) { return std::round(x); }
double toward_zero(double x) { return std::trunc(x); }

} // namespace lockstep::probing
