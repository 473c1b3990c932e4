#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crosscheck/judge/step_row.hpp"

namespace lockstep {

/// Without white space at its ends.
std::string trimmed(std::string_view text);

/// When `continue` stops: what a row of an item's table holds, the GPU's value or else the reference's, beside a
/// number.
struct DebugCondition {
    std::string label;      ///< of the row
    std::string comparison; ///< <, <=, >, >=, == or !=
    double number = 0.0;
};

/// "speed < 0.01", spaces or none. Throws Error where it is no such thing.
DebugCondition parse_condition(const std::string& text);

std::string condition_text(const DebugCondition& condition);

/// The value that a row holds; nothing where there is no such row, or no number in it.
std::optional<float> value_of(std::string_view label, const std::vector<StepRow>& rows);

/// Whether it holds; NaN is != any number, and nothing else.
bool holds(const DebugCondition& condition, float value);

} // namespace lockstep
