#pragma once
#include <string>

#include "crosscheck/judge/system.hpp"
#include "crosscheck/report/value_text.hpp"

namespace lockstep {

/// What the shader's text comes by for an item, by line and variable, and whether it ends in what the GPU made.
std::string text_steps_text(const JudgedPass& pass, std::size_t item, const ItemSteps& text, NumberFormat format);

} // namespace lockstep
