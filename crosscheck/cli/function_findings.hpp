#pragma once
#include <cstddef>
#include <initializer_list>
#include <string>
#include <vector>

#include "crosscheck/cli/function_text.hpp"

namespace lockstep {

/// The rows that are none of these, which ascend.
FunctionRows without(const FunctionRows& rows, const std::vector<UndefinedRow>& undefined);

/// The verdict on a table with such rows, and a line for each; `others`: rows that were judged, all of which agree.
std::string undefined_text(const FunctionRows& rows, const std::vector<UndefinedRow>& undefined, std::size_t others);

/// What the verdict does without, where a function's text is not read. `reasons`: for each text why, empty: it is read.
std::string unread_text(std::initializer_list<std::string> reasons);

} // namespace lockstep
