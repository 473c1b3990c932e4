#include "reference/collision/formulas/fits.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lockstep::formulas {
namespace {

/// To four digits: what a programmer writes down.
float written(float x) {
    if (x == 0.0F || !std::isfinite(x))
        return x;
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(double{x}))) - 3);
    return static_cast<float>(std::round(double{x} / unit) * unit);
}

/// One over a whole number where it is near one, as 1/60 s.
float as_time(float x) {
    const float rate = std::round(1.0F / x);
    return rate >= 2.0F && std::abs(1.0F / rate - x) < 1e-4F * x ? 1.0F / rate : written(x);
}

} // namespace

std::array<float, 3> speed_of(Words, Words after, const Constants&) { return {written(after[6])}; }
std::array<float, 3> gravity_of(Words before, Words after, const Constants& c) {
    std::array<float, 3> g{};
    float largest = 0.0F;
    for (std::size_t i = 0; i < 3; ++i) {
        g[i] = written((after[3 + i] * after[6] - before[3 + i] * before[6]) / c.tick);
        largest = std::max(largest, std::abs(g[i]));
    }
    for (float& x : g)
        if (std::abs(x) < largest * 1e-3F) // what rounding left
            x = 0.0F;
    return g;
}
std::array<float, 3> counted_of(Words before, Words after, const Constants&) {
    const float counted = before[7] - after[7];
    return {before[7] == 0.0F ? counted : as_time(counted)}; // from 0 nothing is rounded
}
std::array<float, 3> moved_for(Words before, Words after, const Constants&) {
    std::size_t along = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::abs(after[3 + i]) > std::abs(after[3 + along]))
            along = i;
    return {as_time((after[along] - before[along]) / (after[3 + along] * after[6]))};
}
std::array<float, 3> collide_time_of(Words, Words after, const Constants&) { return {written(after[7])}; }
std::array<float, 3> factor_of(Words before, Words after, const Constants&) { return {written(after[6] / before[6])}; }
template <int axis> std::array<float, 3> plane_of(Words, Words after, const Constants&) {
    return {written(after[axis])};
}
template std::array<float, 3> plane_of<0>(Words, Words, const Constants&);
template std::array<float, 3> plane_of<1>(Words, Words, const Constants&);
template std::array<float, 3> plane_of<2>(Words, Words, const Constants&);

} // namespace lockstep::formulas
