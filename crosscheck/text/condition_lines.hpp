#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

namespace lockstep {

/// glslang gives a condition that is a variable alone, as `if (found)`, no line of its own: SPIR-V has the statement
/// before it. Adds an OpLine before each such load, with the first line of the text from there on that has the
/// variable as a condition. `words`: a valid module of `text`.
std::vector<std::uint32_t> with_condition_lines(const std::vector<std::uint32_t>& words, std::string_view text);

} // namespace lockstep
