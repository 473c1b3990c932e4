#pragma once
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace lockstep {

/// A set of floats that an operation may legally give: those from `low` to `high`, or any bits at all.
/// The ends are doubles: results of + - * / sqrt on them are one unit wider than rounding makes them, so that the real
/// numbers they stand for stay inside. -0 and +0 are one value: GLSL lets them be interchanged (4.50.7, 4.7.1).
struct Interval {
    double low = 0.0;
    double high = 0.0;
    bool any = false; ///< GL leaves it open: normalize(0), NaN, a division by something that may be 0

    constexpr Interval() = default;
    constexpr Interval(float point) : low(point), high(point) {}
    constexpr Interval(double low_, double high_) : low(low_), high(high_) {}

    static constexpr Interval anything() {
        Interval all;
        all.any = true;
        return all;
    }

    /// One float. NaN is one too: where the arithmetic is the project's own, it is a value like others.
    [[nodiscard]] bool is_point() const { return !any && (low == high || std::isnan(low)); }
    [[nodiscard]] bool contains(float value) const {
        if (any)
            return true;
        if (std::isnan(low) || std::isnan(value))
            return std::isnan(low) && std::isnan(value);
        return low <= value && value <= high;
    }
    [[nodiscard]] bool contains_zero() const { return any || (low <= 0.0 && 0.0 <= high); }
    [[nodiscard]] float as_float() const { return static_cast<float>(low); }
};

namespace interval {

/// One double further out. 0 stays: among floats and their products no result but 0 rounds to it.
inline double below(double x) { return x == 0.0 ? x : std::nextafter(x, -HUGE_VAL); }
inline double above(double x) { return x == 0.0 ? x : std::nextafter(x, HUGE_VAL); }

/// Distance of the two floats around x (GLSL's ULP); at a power of two, where it could be either, the larger; 2^-149
/// below the normal floats.
inline double ulp(double x) {
    if (x == 0.0 || !std::isfinite(x))
        return 0x1p-149;
    constexpr double past_outward = 1.0 + 0x1p-40; // the ends of intervals lie a little to either side
    return std::ldexp(1.0, std::max(std::ilogb(x * past_outward), -126) - 23);
}

inline Interval outward(double low, double high) {
    if (std::isnan(low) || std::isnan(high))
        return Interval::anything();
    return {below(low), above(high)};
}

inline Interval hull(Interval a, Interval b) {
    if (a.any || b.any || std::isnan(a.low) || std::isnan(b.low))
        return Interval::anything();
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

inline Interval add(Interval a, Interval b) {
    return a.any || b.any ? Interval::anything() : outward(a.low + b.low, a.high + b.high);
}

inline double middle(Interval v) { return (v.low + v.high) * 0.5; }

inline Interval negate(Interval a) { return a.any ? a : Interval(-a.high, -a.low); }

inline Interval multiply(Interval a, Interval b) {
    if (a.any || b.any)
        return Interval::anything();
    const double ends[] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
    for (const double end : ends)
        if (std::isnan(end))
            return Interval::anything();
    return outward(*std::min_element(std::begin(ends), std::end(ends)),
                   *std::max_element(std::begin(ends), std::end(ends)));
}

/// |v|.
inline Interval magnitude(Interval v) {
    if (v.any || std::isnan(v.low))
        return v;
    const double low = std::abs(v.low), high = std::abs(v.high);
    return {v.contains_zero() ? 0.0 : std::min(low, high), std::max(low, high)};
}

/// v * v, which multiply(v, v) would let be negative.
inline Interval square(Interval v) {
    const Interval product = multiply(v, v);
    if (product.any)
        return product;
    if (!v.contains_zero())
        return {std::max(std::min(below(v.low * v.low), below(v.high * v.high)), 0.0), product.high};
    return {0.0, product.high};
}

/// Anything where b may be 0.
inline Interval divide(Interval a, Interval b) {
    if (a.any || b.contains_zero())
        return Interval::anything();
    const double ends[] = {a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high};
    for (const double end : ends)
        if (std::isnan(end))
            return Interval::anything();
    return outward(*std::min_element(std::begin(ends), std::end(ends)),
                   *std::max_element(std::begin(ends), std::end(ends)));
}

/// Anything where v may be negative.
inline Interval square_root(Interval v) {
    if (v.any || !(v.low >= 0.0))
        return Interval::anything();
    return {std::max(below(std::sqrt(v.low)), 0.0), above(std::sqrt(v.high))};
}

/// What an operation of an error of up to `ulps` may give instead of exactly `v`; 0 has no error.
inline Interval widen(Interval v, double ulps) {
    if (v.any)
        return v;
    return outward(v.low == 0.0 ? 0.0 : v.low - ulps * ulp(v.low), v.high == 0.0 ? 0.0 : v.high + ulps * ulp(v.high));
}

/// A result or an operand whose subnormals may count as 0.
inline Interval maybe_flushed(Interval v) {
    constexpr double smallest = std::numeric_limits<float>::min();
    if (v.any || !(v.low < smallest && v.high > -smallest))
        return v;
    return {std::min(v.low, 0.0), std::max(v.high, 0.0)};
}

/// The floats inside: what a variable may hold. Never empty: where no float lies inside, the two around. Anything where
/// it may overflow.
inline Interval to_floats(Interval v) {
    constexpr double largest = std::numeric_limits<float>::max();
    if (v.any || v.low < -largest || v.high > largest)
        return Interval::anything();
    auto low = static_cast<float>(v.low);
    auto high = static_cast<float>(v.high);
    if (low < v.low)
        low = std::nextafter(low, HUGE_VALF);
    if (high > v.high)
        high = std::nextafter(high, -HUGE_VALF);
    return low <= high ? Interval(low, high) : Interval(high, low);
}

} // namespace interval
} // namespace lockstep
