#pragma once
#include <bit>
#include <cstdint>

#include "reference/half.hpp"
#include "reference/interval.hpp"
#include "reference/paired_rows.hpp"

namespace lockstep {

/// How a driver converts the floats that it stores as halves: `first` of the rows to the nearest, `second` cut, else to
/// either neighbour (GL 4.5, 2.3.5).
using HalfStore = OfPair;

/// Whether x is a half already, so that no conversion changes it. Of subnormal halves only 0.
inline bool is_half(float x) {
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const std::uint32_t magnitude = bits & 0x7fffffffU;
    return (bits & 0x1fffU) == 0 && (magnitude == 0 || (magnitude >= 0x38800000U && magnitude <= 0x477fe000U));
}

/// What the reference stores. Open: the nearest.
inline float stored_half(float x, HalfStore how) {
    return is_half(x) ? x : how == HalfStore::second ? half_truncated(x) : half_nearest(x);
}

/// What may legally be stored of floats that may lie anywhere in a set.
inline Interval stored_half(const Interval& x, HalfStore how) {
    if (x.any || std::isnan(x.low) || std::isnan(x.high))
        return x;
    const auto low = static_cast<float>(x.low), high = static_cast<float>(x.high);
    if (how == HalfStore::open)
        return {double{half_toward(low, false)}, double{half_toward(high, true)}};
    return {double{stored_half(low, how)}, double{stored_half(high, how)}};
}

} // namespace lockstep
