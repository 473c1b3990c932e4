#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "crosscheck/judge/text_steps.hpp"
#include "crosscheck/text/bound_stage.hpp"
#include "crosscheck/text/pass_text.hpp"

namespace lockstep {

/// The line that a step is shown by: its own, or, of a small function that stands in the place of its call and lies in
/// another file, the call's.
struct ShownLine {
    std::uint32_t line = 0;
    bool is_call = false;
};
ShownLine shown_line(const text::Program& program, std::uint32_t step);

/// Traces one invocation, and gives what it writes; one of a group that shares finds what the others left. Throws Error
/// for what is not run so.
std::vector<text::TracedWord> trace_alone(const BoundStage& stage, std::uint32_t invocation, text::Trace& trace);

/// What a pass's text comes by, item by item; `text()` is asked when an item first is, and throws Error where a text is
/// not interpreted. `resource`: what the pass makes.
std::shared_ptr<const PassSteps> steps_of_text(std::uint8_t resource,
                                               std::function<std::shared_ptr<const PassText>()> text);

} // namespace lockstep
