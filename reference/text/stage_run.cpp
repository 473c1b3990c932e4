#include "reference/text/stage_run.hpp"

#include <algorithm>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"
#include "reference/subnormals.hpp"
#include "reference/text/text_machine.hpp"

namespace lockstep::text {
namespace {

constexpr std::uint32_t at_once = lanes_at_once;
using Run = TextMachine;

/// A built-in input's value where none is given.
std::optional<std::uint32_t> default_word(const StageVariable& input, std::uint32_t invocation) {
    switch (input.builtin.value_or(spv::BuiltInMax)) {
    case spv::BuiltInVertexId:
    case spv::BuiltInVertexIndex:
    case spv::BuiltInPrimitiveId:
        return invocation;
    case spv::BuiltInFrontFacing:
        return 1;
    case spv::BuiltInInstanceId:
    case spv::BuiltInInstanceIndex:
    case spv::BuiltInInvocationId:
    case spv::BuiltInBaseVertex:
    case spv::BuiltInBaseInstance:
    case spv::BuiltInDrawIndex:
    case spv::BuiltInLayer:
    case spv::BuiltInViewportIndex:
    case spv::BuiltInSampleId:
    case spv::BuiltInHelperInvocation:
        return 0;
    default:
        return std::nullopt;
    }
}

bool has_default(const StageVariable& input) { return default_word(input, 0).has_value(); }

/// An input with the words that are given for it.
struct Given {
    const StageVariable* input = nullptr;
    std::span<const std::uint32_t> words; ///< empty: its default

    [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t invocation) const {
        const std::size_t n = input->words();
        return words.size() == n ? words : words.subspan(invocation * n, n);
    }
};

std::vector<Given> given_to(const Program& program, const StageRun& run) {
    std::vector<Given> all;
    std::vector<std::string> names;
    for (const StageVariable& input : program.stage_inputs) {
        names.push_back(name_of(input));
        const auto found = run.inputs.find(names.back());
        if (found == run.inputs.end()) {
            if (needs_words(input))
                throw Error(fmt::format("input {} of the stage is not given", names.back()));
            if (has_default(input))
                all.push_back({&input, {}});
            continue;
        }
        Given& one = all.emplace_back(Given{&input, {}});
        const std::size_t n = input.words();
        if (found->second.size() != n && found->second.size() != n * run.invocations)
            throw Error(fmt::format("input {}: expected {} words, or {} for {} invocations, got {}", names.back(), n,
                                    n * run.invocations, run.invocations, found->second.size()));
        one.words = found->second;
    }
    for (const auto& [name, words] : run.inputs)
        if (std::find(names.begin(), names.end(), name) == names.end())
            throw Error(fmt::format("input {}: the stage has no such input; it has {}{}", name,
                                    names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")),
                                    did_you_mean(name, names)));
    return all;
}

/// Adds what one lane made to the result.
void take(const Program& program, const Run& run, std::size_t l, StageResult& result) {
    const bool is_geometry = program.stage == spv::ExecutionModelGeometry;
    const std::uint32_t vertices = is_geometry ? run.vertices(l) : 1, first = result.vertices;
    result.is_discarded.push_back(run.is_discarded(l) ? 1 : 0);
    for (const StageVariable& output : program.stage_outputs) {
        std::vector<std::uint32_t>& words = result.outputs[name_of(output)];
        for (std::uint32_t v = 0; v < vertices; ++v)
            for (std::uint32_t c = output.cell; c < output.cell + output.cells; ++c)
                words.push_back(run.is_discarded(l) ? 0 : run.made(l)[v * program.output_cells + c].word());
    }
    result.vertices += vertices;
    std::uint32_t begun = 0;
    const auto end = [&](std::uint32_t at) {
        if (at > begun)
            result.strips.push_back({run.invocation(l).number, first + begun, at - begun});
        begun = at;
    };
    for (const std::uint32_t at : run.ends(l))
        end(at);
    if (is_geometry)
        end(vertices);
}

} // namespace

std::string name_of(const StageVariable& variable) {
    return variable.name.empty() ? fmt::format("location {}", variable.location.value_or(0)) : variable.name;
}

bool needs_words(const StageVariable& input) { return input.is_read && !has_default(input); }

std::vector<GivenInput> inputs_of(const Program& program, const StageRun& run, std::uint32_t invocation) {
    std::vector<GivenInput> all;
    for (const Given& one : given_to(program, run)) {
        const std::span<const std::uint32_t> words = one.words.empty() ? one.words : one.of(invocation);
        all.push_back({one.input, {words.begin(), words.end()}});
        if (one.words.empty())
            all.back().words.push_back(default_word(*one.input, invocation).value_or(0));
    }
    return all;
}

StageResult run_stage(const Program& program, const StageRun& run, const Bindings& bindings, const Profile& profile,
                      Findings& findings) {
    if (program.stage == spv::ExecutionModelGLCompute)
        throw Error("a compute stage is run by dispatches; expected a vertex, geometry or fragment stage");
    const FlushSubnormals guard{profile.flush_subnormals, profile.flush_subnormals};
    TextValues values(profile);
    Races races(findings);
    Memory memory(program, bindings, findings, run.is_watched ? &races : nullptr);
    memory.start_group(0);
    const std::vector<Given> given = given_to(program, run);
    Run machine(values, program, memory, bindings, {1, 1, 1}, run.most_branches);
    machine.are_quads = run.are_quads;
    machine.subgroup_size = run.subgroup_size;
    machine.coverage = run.coverage;
    StageResult result;
    for (const StageVariable& output : program.stage_outputs)
        if (run.keeps_outputs)
            result.outputs[name_of(output)].reserve(std::size_t{output.cells} * run.invocations);
    std::vector<Invocation> invocations;
    for (std::uint32_t first = 0; first < run.invocations; first += at_once) {
        if (run.wants && !run.wants(first))
            continue;
        invocations.clear();
        for (std::uint32_t l = 0; l < at_once && first + l < run.invocations; ++l)
            invocations.push_back({.number = first + l});
        machine.start(invocations);
        for (std::uint32_t l = 0; l < invocations.size(); ++l)
            for (const Given& one : given) {
                const std::uint32_t made_up = default_word(*one.input, first + l).value_or(0);
                machine.give(*one.input, l, one.words.empty() ? std::span(&made_up, 1) : one.of(first + l));
            }
        try {
            machine.run();
        } catch (const DoesNotEnd& endless) {
            if (!run.is_watched)
                throw;
            findings.add(endless.rule, endless.place, [&] { return endless.why; });
            break;
        }
        for (std::uint32_t l = 0; run.keeps_outputs && l < invocations.size(); ++l)
            take(program, machine, l, result);
    }
    return result;
}

} // namespace lockstep::text
