#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace lockstep {

/// To the nearest half, ties to even; magnitudes below 2^-14 become +0, above 65504 they become 65504; NaN stays. Twin
/// of half_round in shaders/half.glsl.
inline float half_round(float x) {
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const std::uint32_t magnitude = bits & 0x7fffffffU, sign = bits & 0x80000000U;
    if (magnitude < 0x38800000U)
        return 0.0F;
    if (magnitude > 0x7f800000U)
        return x;
    const std::uint32_t rounded = (magnitude + 0xfffU + ((magnitude >> 13U) & 1U)) & ~0x1fffU;
    return std::bit_cast<float>(sign | std::min(rounded, 0x477fe000U));
}

/// The distance between halves at a magnitude, subnormal ones included.
inline double half_unit(double magnitude) {
    return std::ldexp(1.0, (magnitude < 0x1p-14 ? -14 : std::ilogb(magnitude)) - 10);
}

/// To the half below or above (toward zero: `up` of a negative one), subnormal halves and infinity included. NaN stays.
inline float half_toward(float x, bool up) {
    if (!std::isfinite(x))
        return x;
    const double unit = half_unit(std::abs(double{x}));
    const double rounded = (up ? std::ceil(double{x} / unit) : std::floor(double{x} / unit)) * unit;
    if (std::abs(rounded) >= 65536.0)
        return up == (rounded > 0.0) ? std::copysign(HUGE_VALF, x) : std::copysign(65504.0F, x);
    return static_cast<float>(rounded);
}

/// To the nearest, ties to even, subnormal halves included; from 65520 up infinity (IEEE 754, 4.3.1). NaN stays.
inline float half_nearest(float x) {
    if (!std::isfinite(x))
        return x;
    const double unit = half_unit(std::abs(double{x}));
    const double rounded = std::nearbyint(double{x} / unit) * unit;
    return std::abs(rounded) >= 65536.0 ? std::copysign(HUGE_VALF, x) : static_cast<float>(rounded);
}

/// Toward zero: what some drivers store and blend.
inline float half_truncated(float x) { return half_toward(x, x < 0.0F); }

} // namespace lockstep
