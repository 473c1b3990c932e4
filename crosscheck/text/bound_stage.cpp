#include "crosscheck/text/bound_stage.hpp"

#include "reference/model/error.hpp"
#include "reference/text/trace.hpp"

namespace lockstep {
text::Invocation BoundStage::invocation(std::uint32_t number) const {
    return run != nullptr ? text::Invocation{.number = number} : text::invocation_of(program, groups, number);
}

std::vector<text::GivenInput> BoundStage::inputs(std::uint32_t invocation) const {
    return run != nullptr ? text::inputs_of(program, *run, invocation) : std::vector<text::GivenInput>();
}

text::TracedRun BoundStage::traced(std::uint32_t number, std::span<const text::ForcedRow> forced) const {
    text::TracedRun made;
    made.words =
        text::run_traced(program, invocation(number), groups, bindings, profile, forced, made.trace, inputs(number));
    return made;
}

std::optional<std::string> BoundStage::line_of(std::uint32_t invocation, const text::WrittenPlace& place) const try {
    std::optional<std::string> line;
    for (const text::TraceRow& row : traced(invocation).trace.rows)
        if (row.kind == text::TraceRow::Kind::store && row.place == place)
            line = program.line_name(row.line);
    return line;
} catch (const Error&) {
    return {}; // run together with others
}

} // namespace lockstep
