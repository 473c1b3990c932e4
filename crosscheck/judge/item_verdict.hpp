#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "crosscheck/judge/lean.hpp"
#include "reference/interval.hpp"
#include "reference/tie.hpp"
#include "reference/undefined.hpp"

namespace lockstep {

/// What an item that is not bit-equal is; exactly one of these.
enum class DifferenceClass {
    rounding,  ///< the same decisions; every field inside the interval that GLSL's precision rules allow
    tie,       ///< another decision that rounding can take
    undefined, ///< rests on what GL leaves open
    divergent, ///< no legal run explains it
};
inline constexpr std::array<std::string_view, 4> class_names{"rounding", "tie", "undefined", "divergent"};

struct ItemVerdict {
    std::size_t index = 0; ///< texels are counted row by row from the bottom
    DifferenceClass kind = DifferenceClass::divergent;
    std::size_t outcomes = 1; ///< legal ones
    std::optional<Tie> tie = std::nullopt;
    Undefined undefined = Undefined::none;
    /// A legal set for each component of its resource: those that the GPU's values lie in; of a divergent item those
    /// that the reference's own lie in. Empty: not known, or points in which the reference alone lies.
    std::vector<Interval> sets = {};
    bool follows_particle = false;           ///< a texel that holds what the GPU's own particles leave there
    std::optional<Lean> lean = std::nullopt; ///< of a texel that is a tie or divergent, where a shift would explain it
};

} // namespace lockstep
