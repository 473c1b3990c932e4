#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>

#include "reference/model/lifecycle/switches.hpp"

namespace lockstep::lifecycle {

/// The half of a float, its bits. `dither`: random bits, of which as many as are cut off are added. Finite numbers stay
/// finite; NaN is 7e00.
constexpr std::uint32_t half_code(float x, HalfRounding rounding, std::uint32_t dither = 0) {
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const std::uint32_t magnitude = bits & 0x7fffffffU, sign = (bits >> 16U) & 0x8000U;
    if (magnitude > 0x7f800000U)
        return 0x7e00U;
    if (magnitude == 0x7f800000U)
        return sign | 0x7c00U;
    // What is cut off: `cut` bits of `whole`.
    std::uint32_t whole = 0, cut = 13;
    if (magnitude >= 0x38800000U) {
        whole = magnitude - 0x38000000U;
    } else {
        const std::uint32_t exponent = magnitude >> 23U;
        if (exponent < (rounding == HalfRounding::dithered ? 103U : 102U))
            return sign;
        whole = (magnitude & 0x7fffffU) | 0x800000U;
        cut = 126U - exponent;
    }
    const std::uint32_t lowest_kept = (whole >> cut) & 1U;
    switch (rounding) {
    case HalfRounding::toward_zero:
        break;
    case HalfRounding::nearest_even:
        whole += (1U << (cut - 1U)) - 1U + lowest_kept;
        break;
    case HalfRounding::dithered:
        whole += dither & ((1U << cut) - 1U);
        break;
    }
    return sign | std::min(whole >> cut, 0x7bffU);
}

/// Exact.
constexpr float half_value(std::uint32_t code) {
    const std::uint32_t magnitude = code & 0x7fffU, sign = (code & 0x8000U) << 16U;
    if (magnitude < 0x400U)
        return std::bit_cast<float>(std::bit_cast<std::uint32_t>(static_cast<float>(magnitude) * 0x1p-24F) | sign);
    if (magnitude >= 0x7c00U)
        return std::bit_cast<float>(0x7f800000U | ((magnitude & 0x3ffU) << 13U) | sign);
    return std::bit_cast<float>(((magnitude << 13U) + 0x38000000U) | sign);
}

} // namespace lockstep::lifecycle
