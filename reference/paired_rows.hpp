#pragma once
#include <string_view>

#include "reference/model/profile.hpp"

namespace lockstep {

/// Two ways of a driver that exclude each other, each with a row of its own among those that a profile may not follow.
/// The probe rules out every way that it did not find. A profile that rules out neither was made by an older probe,
/// which did not look: what the rows are about is then open, as where both are ruled out.
struct PairedRows {
    std::string_view first, second;
};

enum class OfPair { first, second, open };

inline OfPair measured_of(const Profile& profile, const PairedRows& rows) {
    const bool first = profile.follows(rows.first), second = profile.follows(rows.second);
    return first == second ? OfPair::open : first ? OfPair::first : OfPair::second;
}

/// Floats that a fragment stage, or imageStore, leaves to the driver to convert to halves: to the nearest, ties to
/// even, or cut, which is toward zero.
inline constexpr PairedRows drawn_half_rows{"image: float to half, nearest even", "image: float to half, cut"};
inline constexpr PairedRows stored_half_rows{"image: store to half, nearest even", "image: store to half, cut"};
/// Floats that a fragment stage leaves to it to convert to codes of 8 bits.
inline constexpr PairedRows drawn_unorm8_rows{"image: float to unorm8, nearest", "image: float to unorm8, cut"};
/// Points one pixel wide whose centre lies outside the view volume by less than the sub-pixel grid resolves: dropped as
/// GL says (4.5, 13.5), or drawn where the grid puts them.
inline constexpr PairedRows brink_rows{"image: points just outside, dropped", "image: points just outside, drawn"};

} // namespace lockstep
