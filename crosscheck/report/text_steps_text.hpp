#pragma once
#include <string>
#include <vector>

#include "crosscheck/judge/system.hpp"
#include "crosscheck/judge/text_steps.hpp"
#include "crosscheck/report/value_text.hpp"

namespace lockstep {

/// What one statement gives a variable, or a decision; of a loop each turn.
struct TextLine {
    std::string where, name, value;
};
std::vector<TextLine> text_lines(const ItemSteps& text, NumberFormat format);

/// What the shader's text computes for an item, by line and variable, and whether it ends in what the GPU made.
std::string text_steps_text(const JudgedPass& pass, std::size_t item, const ItemSteps& text, NumberFormat format);

} // namespace lockstep
