#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crosscheck/judge/text_steps.hpp"
#include "crosscheck/report/text_steps_text.hpp"

namespace lockstep {

/// A line of a shader's text that an item comes to, and what it sets there.
struct DebugLine {
    std::string where, source;
    std::vector<TextLine> values = {};
};

/// In the order in which the item comes to them. Throws Error saying why there are none.
std::vector<DebugLine> debug_lines(const ItemSteps& text, NumberFormat format);

/// The line as it stands in the text, and below it the values.
std::string debug_line_text(const DebugLine& line);

/// FILE:LINE of `break`; nothing: it is a condition of another kind.
std::optional<std::string> line_of_break(std::string_view argument);

} // namespace lockstep
