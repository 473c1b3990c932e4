#include "reference/text/trace.hpp"

#include <bit>
#include <map>

#include <fmt/format.h>

#include "reference/subnormals.hpp"
#include "reference/text/glsl_functions.hpp"
#include "reference/text/group_memory.hpp"
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

namespace {

/// A run of one invocation that is noted. `prepare(machine, words written)`: before it runs; `memory` is what it reads.
template <class Prepare>
WrittenWords<TracedValues> run_noted(const Program& program, const Invocation& invocation,
                                     std::array<std::uint32_t, 3> groups, const Bindings& bindings,
                                     const Profile& profile, std::span<const ForcedRow> forced, Trace& trace,
                                     Memory& memory, std::span<const GivenInput> inputs, const Prepare& prepare) {
    const bool is_compute = program.stage == spv::ExecutionModelGLCompute;
    const bool operands = is_compute ? profile.compute_flush_subnormals : profile.flush_subnormals;
    const FlushSubnormals guard{operands, is_compute ? profile.compute_flush_results.value_or(operands) : operands};
    TracedValues values(profile);
    WrittenWords<TracedValues> written;
    constexpr std::uint32_t most_branches = 200'000;
    Machine<TracedValues, 1> run(values, program, memory, bindings, groups, most_branches);
    run.keep(written);
    trace.rows.clear();
    trace.operands.clear();
    trace.calls.clear();
    trace.settings.clear();
    run.note_into(trace, forced);
    prepare(run, written);
    run.start({&invocation, 1});
    for (const GivenInput& one : inputs)
        run.give(*one.input, 0, one.words);
    run.run();
    return written;
}

} // namespace

std::vector<TracedWord> run_traced(const Program& program, const Invocation& invocation,
                                   std::array<std::uint32_t, 3> groups, const Bindings& bindings,
                                   const Profile& profile, std::span<const ForcedRow> forced, Trace& trace,
                                   std::span<const GivenInput> inputs) {
    Findings ignored;
    Memory memory(program, bindings, ignored, nullptr);
    std::vector<TracedWord> words;
    for (const auto& [place, cell] :
         run_noted(program, invocation, groups, bindings, profile, forced, trace, memory, inputs, [](auto&, auto&) {}))
        if (place.space != WrittenPlace::Space::shared)
            words.push_back({place, cell.word()});
    return words;
}

std::vector<TracedWord> run_traced_in_group(const Program& program, const Invocation& invocation,
                                            std::array<std::uint32_t, 3> groups, const Bindings& bindings,
                                            const Profile& profile, std::span<const ForcedRow> forced, Trace& trace,
                                            GroupMemory& group, std::optional<std::size_t> stretch) {
    Bindings now = bindings;
    Findings ignored;
    Memory memory(program, now, ignored, nullptr);
    std::size_t at = 0;
    const auto enter = [&] {
        GroupMemory::Moment& moment = group.moments[at];
        for (std::size_t b = 0; b < now.blocks.size(); ++b)
            now.blocks[b] = moment.words[b];
        for (std::size_t i = 0; i < now.images.size(); ++i)
            now.images[i].words = moment.words[now.blocks.size() + i];
        for (std::uint32_t w = 0; w < moment.shared.size(); ++w)
            memory.store_shared(w, moment.shared[w], {});
    };
    enter();
    std::map<WrittenPlace, std::uint32_t> all;
    const auto gather = [&](const WrittenWords<TracedValues>& written) {
        for (const auto& [place, cell] : written)
            if (stretch || place.space != WrittenPlace::Space::shared)
                all[place] = cell.word();
    };
    const WrittenWords<TracedValues> last =
        run_noted(program, invocation, groups, now, profile, forced, trace, memory, {}, [&](auto& run, auto& written) {
            run.meet([&] {
                if (at == stretch || at + 1 == group.moments.size())
                    return false;
                ++at;
                if (!stretch)
                    gather(written);
                written.clear();
                enter();
                return true;
            });
        });
    if (!stretch || at == *stretch)
        gather(last);
    std::vector<TracedWord> words;
    for (const auto& [place, bits] : all)
        words.push_back({place, bits});
    return words;
}

} // namespace lockstep::text
