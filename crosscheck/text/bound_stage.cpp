#include "crosscheck/text/bound_stage.hpp"

#include "crosscheck/text/group_witness.hpp"
#include "reference/model/error.hpp"
#include "reference/text/group_memory.hpp"
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

ShownLine shown_line(const text::Program& program, std::uint32_t step) {
    const auto file_of = [&](std::uint32_t line) {
        const std::string where = program.line_name(line);
        return where.substr(0, where.rfind(':'));
    };
    ShownLine at{program.lines[step]};
    for (std::uint32_t k = program.in_place_of[step]; k != 0; k = program.in_place[k - 1].outer) {
        const std::uint32_t call = program.in_place[k - 1].line;
        if (file_of(at.line) == file_of(call))
            break;
        at = {call, true};
    }
    return at;
}

std::vector<text::TracedWord> trace_alone(const BoundStage& stage, std::uint32_t number, text::Trace& trace) {
    const text::Invocation invocation = stage.invocation(number);
    if (!shares(stage.program))
        return text::run_traced(stage.program, invocation, stage.groups, stage.bindings, stage.profile, {}, trace,
                                stage.inputs(number));
    text::GroupMemory memory = text::remembered_group(stage.program, stage.groups, stage.bindings, stage.profile,
                                                      number / stage.program.invocations());
    return text::run_traced_in_group(stage.program, invocation, stage.groups, stage.bindings, stage.profile, {}, trace,
                                     memory, {});
}

} // namespace lockstep
