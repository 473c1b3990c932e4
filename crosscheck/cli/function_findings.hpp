#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "crosscheck/cli/function_text.hpp"

namespace lockstep {

/// The rows that are none of these, which ascend.
FunctionRows without(const FunctionRows& rows, const std::vector<UndefinedRow>& undefined);

/// The verdict on a table with such rows, and a line for each; `others`: rows that were judged, all of which agree.
std::string undefined_text(const FunctionRows& rows, const std::vector<UndefinedRow>& undefined, std::size_t others);

} // namespace lockstep
