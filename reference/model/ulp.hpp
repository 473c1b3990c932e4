#pragma once
#include <bit>
#include <cstdint>

namespace lockstep {

/// Floats on the integer line: neighbouring values differ by 1, -0 and +0 are the same point, a sign flip is far.
inline std::int64_t ordered(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const auto magnitude = static_cast<std::int64_t>(bits & 0x7fffffffU);
    return (bits >> 31U) != 0 ? -magnitude : magnitude;
}

/// Distance in units in the last place; NaN against a number is the largest distance there is, two NaNs are equal.
inline std::int64_t ulp_distance(float a, float b) {
    const bool a_nan = a != a;
    const bool b_nan = b != b;
    if (a_nan || b_nan)
        return a_nan && b_nan ? 0 : INT64_MAX;
    const std::int64_t distance = ordered(a) - ordered(b);
    return distance < 0 ? -distance : distance;
}

/// Whether two floats count as the same: the same bits, or both NaN.
inline bool same_bits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || (a != a && b != b);
}

} // namespace lockstep
