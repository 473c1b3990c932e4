#include "reference/text/trace.hpp"

#include <bit>

#include <fmt/format.h>

#include "reference/subnormals.hpp"
#include "reference/text/glsl_functions.hpp"
#include "reference/text/machine_flow.hpp"
#include "reference/text/machine_trace.hpp"

namespace lockstep::text {

std::vector<std::uint32_t> lines_of(const Program& program, const Trace& trace, const TraceRow& row) {
    std::vector<std::uint32_t> lines;
    std::uint32_t step = row.step;
    for (std::uint32_t call = row.calls;; call = trace.calls[call - 1].outer) {
        lines.push_back(program.lines[step]);
        for (std::uint32_t k = program.in_place_of[step]; k != 0; k = program.in_place[k - 1].outer)
            lines.push_back(program.in_place[k - 1].line);
        if (call == 0)
            return lines;
        step = trace.calls[call - 1].step;
    }
}

std::string value_text(std::uint32_t bits, bool is_real) {
    return is_real ? fmt::format("{:.9g}", std::bit_cast<float>(bits))
                   : fmt::format("{}", static_cast<std::int32_t>(bits));
}

std::vector<TracedWord> run_traced(const Program& program, const Invocation& invocation,
                                   std::array<std::uint32_t, 3> groups, const Bindings& bindings,
                                   const Profile& profile, std::span<const ForcedRow> forced, Trace& trace,
                                   std::span<const GivenInput> inputs) {
    const bool is_compute = program.stage == spv::ExecutionModelGLCompute;
    const bool operands = is_compute ? profile.compute_flush_subnormals : profile.flush_subnormals;
    const FlushSubnormals guard{operands, is_compute ? profile.compute_flush_results.value_or(operands) : operands};
    TracedValues values(profile);
    Findings ignored;
    Memory memory(program, bindings, ignored, nullptr);
    WrittenWords<TracedValues> written;
    constexpr std::uint32_t most_branches = 200'000;
    Machine<TracedValues, 1> run(values, program, memory, bindings, groups, most_branches);
    run.keep(written);
    trace.rows.clear();
    trace.operands.clear();
    trace.calls.clear();
    run.note_into(trace, forced);
    run.start({&invocation, 1});
    for (const GivenInput& one : inputs)
        run.give(*one.input, 0, one.words);
    run.run();
    std::vector<TracedWord> words;
    for (const auto& [place, cell] : written)
        if (place.space != WrittenPlace::Space::shared)
            words.push_back({place, cell.word()});
    return words;
}

} // namespace lockstep::text
