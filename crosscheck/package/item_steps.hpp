#pragma once
#include <cstdint>
#include <functional>
#include <memory>

#include "crosscheck/judge/text_steps.hpp"
#include "crosscheck/text/pass_text.hpp"

namespace lockstep {

/// What a pass's text computes, item by item; `text()` is asked when an item first is, and throws Error where a text is
/// not interpreted. `resource`: what the pass makes.
std::shared_ptr<const PassSteps> steps_of_text(std::uint8_t resource,
                                               std::function<std::shared_ptr<const PassText>()> text);

} // namespace lockstep
