#include "reference/text/dispatch.hpp"

#include <algorithm>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "reference/model/error.hpp"
#include "reference/subnormals.hpp"
#include "reference/text/glsl_functions.hpp"
#include "reference/text/machine_flow.hpp"
#include "reference/text/machine_memory.hpp"

namespace lockstep::text {
namespace {

constexpr int width = 16;
using Run = Machine<TextValues, width>;

std::array<std::uint32_t, 3> place_in(std::uint32_t number, const std::array<std::uint32_t, 3>& size) {
    return {number % size[0], number / size[0] % size[1], number / size[0] / size[1]};
}

std::string line_of(const Program& program, const Step* step) {
    return program.line_name(program.lines[static_cast<std::size_t>(step - program.steps.data())]);
}

/// All of a group have come to one barrier, or ended. Returns whether they ended.
bool all_ended(const Program& program, std::span<const std::unique_ptr<Run>> parts) {
    const Step* first = nullptr;
    std::size_t waiting = 0;
    for (const std::unique_ptr<Run>& part : parts)
        for (std::size_t l = 0; l < part->size(); ++l)
            if (const Step* barrier = part->barrier(l)) {
                first = first == nullptr ? barrier : first;
                ++waiting;
                if (barrier != first)
                    throw Error(fmt::format("shader {}: invocations of a group wait at this barrier and at that of {}; "
                                            "expected all at one (GLSL 4.60, 8.16)",
                                            line_of(program, first), line_of(program, barrier)));
            }
    if (waiting != 0 && waiting != program.invocations())
        throw Error(fmt::format("shader {}: {} of a group's {} invocations end before this barrier; expected all at "
                                "one (GLSL 4.60, 8.16)",
                                line_of(program, first), program.invocations() - waiting, program.invocations()));
    return waiting == 0;
}

/// The invocations of a group that has barriers or shared variables, from barrier to barrier.
void run_group(const Program& program, Memory& memory, std::span<const std::unique_ptr<Run>> parts,
               std::span<const Invocation> invocations) {
    memory.start_group();
    for (std::size_t part = 0; part < parts.size(); ++part)
        parts[part]->start(
            invocations.subspan(part * width, std::min<std::size_t>(width, invocations.size() - part * width)));
    do {
        for (const std::unique_ptr<Run>& part : parts)
            part->run();
    } while (!all_ended(program, parts));
}

} // namespace

void run_dispatch(const Program& program, const Dispatch& dispatch, const Bindings& bindings, const Profile& profile,
                  Findings& findings) {
    const FlushSubnormals guard{profile.compute_flush_subnormals,
                                profile.compute_flush_results.value_or(profile.compute_flush_subnormals)};
    TextValues values(profile);
    Memory memory(program, bindings, findings);
    const bool is_joint = program.barriers > 0 || program.shared > 0;
    const std::uint32_t size = program.invocations();
    std::vector<std::unique_ptr<Run>> parts;
    for (std::uint32_t part = 0; part < (is_joint ? (size + width - 1) / width : 1); ++part)
        parts.push_back(std::make_unique<Run>(values, program, memory, bindings, dispatch.groups));
    std::vector<Invocation> waiting; // of one group, or of several that need nothing of each other
    const auto flush = [&] {
        if (waiting.empty())
            return;
        if (is_joint) {
            run_group(program, memory, parts, waiting);
        } else {
            parts.front()->start(waiting);
            parts.front()->run();
        }
        waiting.clear();
    };
    const std::uint32_t groups = dispatch.groups[0] * dispatch.groups[1] * dispatch.groups[2];
    for (std::uint32_t g = 0; g < groups; ++g) {
        const std::array<std::uint32_t, 3> group = place_in(g, dispatch.groups);
        if (dispatch.wants && !dispatch.wants(group))
            continue;
        for (std::uint32_t i = 0; i < size; ++i) {
            waiting.push_back({group, place_in(i, program.group), g * size + i});
            if (!is_joint && waiting.size() == width)
                flush();
        }
        if (is_joint)
            flush();
    }
    flush();
}

} // namespace lockstep::text
