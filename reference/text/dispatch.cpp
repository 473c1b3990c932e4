#include "reference/text/dispatch.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "reference/subnormals.hpp"
#include "reference/text/group_memory.hpp"
#include "reference/text/machine_checks.hpp"
#include "reference/text/text_machine.hpp"

namespace lockstep::text {
namespace {

constexpr std::size_t width = lanes_at_once;
using Run = TextMachine;

std::array<std::uint32_t, 3> place_in(std::uint32_t number, const std::array<std::uint32_t, 3>& size) {
    return {number % size[0], number / size[0] % size[1], number / size[0] / size[1]};
}

/// Of an invocation in its group, quad after quad where there are any.
std::array<std::uint32_t, 3> local_place(const Program& program, std::uint32_t number) {
    if (!program.are_square_quads)
        return place_in(number, program.group);
    const std::array<std::uint32_t, 3> quad =
        place_in(number / 4, {program.group[0] / 2, program.group[1] / 2, program.group[2]});
    return {2 * quad[0] + number % 2, 2 * quad[1] + number / 2 % 2, quad[2]};
}

/// What the invocations of a group do next.
enum class GroupState : std::uint8_t { ended, waiting, stuck };

/// Whether all of a group have come to one barrier, or ended; else a finding.
GroupState state_of(const Program& program, std::span<const std::unique_ptr<Run>> parts, Findings& findings) {
    constexpr std::string_view rule = "barrier that not all invocations of a group come to (GLSL 4.60, 8.16)";
    const auto line = [&](const Step* step) {
        return program.lines[static_cast<std::size_t>(step - program.steps.data())];
    };
    const Step* first = nullptr;
    Place place;
    std::size_t waiting = 0;
    for (const std::unique_ptr<Run>& part : parts)
        for (std::size_t l = 0; l < part->size(); ++l)
            if (const Step* barrier = part->barrier(l)) {
                ++waiting;
                if (first == nullptr) {
                    first = barrier;
                    place = {line(first), part->invocation(l).number};
                } else if (barrier != first) {
                    const Place other{line(barrier), part->invocation(l).number};
                    findings.add(
                        rule, place,
                        [&] {
                            return fmt::format("invocation {} waits here, invocation {} at another barrier",
                                               place.invocation, other.invocation);
                        },
                        other);
                    return GroupState::stuck;
                }
            }
    if (waiting == 0)
        return GroupState::ended;
    if (waiting == program.invocations())
        return GroupState::waiting;
    findings.add(rule, place, [&] {
        return fmt::format("{} of {} invocations end before it", program.invocations() - waiting,
                           program.invocations());
    });
    return GroupState::stuck;
}

/// The invocations of a group that has barriers or shared variables, from barrier to barrier. `before_each()`: before
/// each stretch between two barriers.
template <class BeforeEach> void run_group(const Program& program, Memory& memory,
                                           std::span<const std::unique_ptr<Run>> parts,
                                           std::span<const Invocation> invocations, const BeforeEach& before_each) {
    memory.start_group(invocations.front().number / program.invocations());
    for (std::size_t part = 0; part < parts.size(); ++part)
        parts[part]->start(
            invocations.subspan(part * width, std::min<std::size_t>(width, invocations.size() - part * width)));
    for (;;) {
        before_each();
        for (const std::unique_ptr<Run>& part : parts)
            part->run();
        if (state_of(program, parts, memory.findings()) != GroupState::waiting)
            return;
        if (memory.races() != nullptr)
            memory.races()->barrier(parts.front()->barrier(0)->a);
    }
}

} // namespace

Invocation invocation_of(const Program& program, const std::array<std::uint32_t, 3>& groups, std::uint32_t number) {
    const std::uint32_t size = program.invocations();
    return {place_in(number / size, groups), local_place(program, number % size), number};
}

bool run_dispatch(const Program& given, const Dispatch& dispatch, const Bindings& bindings, const Profile& profile,
                  Findings& findings) {
    const bool is_whole = dispatch.is_watched || dispatch.coverage != nullptr || given.fewer == nullptr;
    const Program& program = is_whole ? given : *given.fewer;
    const FlushSubnormals guard{profile.compute_flush_subnormals,
                                profile.compute_flush_results.value_or(profile.compute_flush_subnormals)};
    TextValues values(profile);
    Races races(findings, program.invocations());
    Memory memory(program, bindings, findings, dispatch.is_watched ? &races : nullptr, dispatch.writers);
    // Groups that are watched are told apart.
    const bool is_joint = program.barriers > 0 || program.shared > 0 || dispatch.is_watched ||
                          program.choice_line != 0 || program.are_quads;
    const std::uint32_t size = program.invocations();
    std::vector<std::unique_ptr<Run>> parts;
    for (std::uint32_t part = 0; part < (is_joint ? (size + width - 1) / width : 1); ++part)
        parts.push_back(
            std::make_unique<Run>(values, program, memory, bindings, dispatch.groups, dispatch.most_branches));
    for (const std::unique_ptr<Run>& part : parts)
        part->subgroup_size = dispatch.subgroup_size, part->are_quads = program.are_quads,
        part->coverage = dispatch.coverage;
    std::vector<Invocation> waiting; // of one group, or of several that need nothing of each other
    const auto flush = [&] {
        if (waiting.empty())
            return;
        if (is_joint) {
            run_group(program, memory, parts, waiting, [] {});
        } else {
            parts.front()->start(waiting);
            parts.front()->run();
        }
        waiting.clear();
    };
    const std::uint32_t groups = dispatch.groups[0] * dispatch.groups[1] * dispatch.groups[2];
    try {
        for (std::uint32_t k = 0; k < groups; ++k) {
            const std::uint32_t g = dispatch.is_reversed ? groups - 1 - k : k;
            const std::array<std::uint32_t, 3> group = place_in(g, dispatch.groups);
            if (dispatch.wants && !dispatch.wants(group))
                continue;
            for (std::uint32_t i = 0; i < size; ++i) {
                waiting.push_back({group, local_place(program, i), g * size + i});
                if (!is_joint && waiting.size() == width)
                    flush();
            }
            if (is_joint)
                flush();
        }
        flush();
    } catch (const DoesNotEnd& endless) {
        if (!dispatch.is_watched)
            throw;
        findings.add(endless.rule, endless.place, [&] { return endless.why; });
    }
    // What a race reads may be there or not: the race says it all.
    const std::vector<Finding> all = findings.all();
    findings.remove([&](const Finding& one) {
        return one.rule == unset_shared_rule && std::any_of(all.begin(), all.end(), [&](const Finding& race) {
                   return race.other && (race.place.line == one.place.line || race.other->line == one.place.line);
               });
    });
    return races.has_handed_on();
}

namespace {

/// A copy of what is bound.
struct OwnBindings {
    std::vector<std::vector<std::uint32_t>> words; // several blocks may have one's
    Bindings bindings;

    explicit OwnBindings(const Bindings& from) : bindings(from) {
        words.reserve(from.blocks.size() + from.images.size());
        for (std::size_t b = 0; b < from.blocks.size(); ++b) {
            words.emplace_back(from.blocks[b].begin(), from.blocks[b].end());
            bindings.blocks[b] = words.back();
            for (std::size_t a = 0; a < b; ++a)
                if (from.blocks[a].data() == from.blocks[b].data())
                    bindings.blocks[b] = bindings.blocks[a].first(from.blocks[b].size());
        }
        for (std::size_t i = 0; i < from.images.size(); ++i) {
            words.emplace_back(from.images[i].words.begin(), from.images[i].words.end());
            bindings.images[i].words = words.back();
        }
    }
    OwnBindings(const OwnBindings&) = delete;
    OwnBindings& operator=(const OwnBindings&) = delete;
};

/// Runs one group. `before_each(memory)`: before each stretch.
template <class BeforeEach> void run_one_group(const Program& program, const std::array<std::uint32_t, 3>& groups,
                                               const Bindings& own, const Profile& profile, std::uint32_t group,
                                               Memory& memory, const BeforeEach& before_each) {
    const FlushSubnormals guard{profile.compute_flush_subnormals,
                                profile.compute_flush_results.value_or(profile.compute_flush_subnormals)};
    TextValues values(profile);
    const std::uint32_t size = program.invocations();
    std::vector<std::unique_ptr<Run>> parts;
    std::vector<Invocation> invocations;
    for (std::uint32_t i = 0; i < size; ++i) {
        if (i % width == 0) {
            constexpr std::uint32_t most_branches = 50'000'000;
            parts.push_back(std::make_unique<Run>(values, program, memory, own, groups, most_branches));
        }
        invocations.push_back(invocation_of(program, groups, group * size + i));
    }
    run_group(program, memory, parts, invocations, before_each);
}

} // namespace

GroupMemory remembered_group(const Program& program, const std::array<std::uint32_t, 3>& groups,
                             const Bindings& bindings, const Profile& profile, std::uint32_t group) {
    constexpr std::size_t most_words = std::size_t{1} << 24U;
    GroupMemory made;
    const OwnBindings own(bindings);
    Findings ignored;
    Memory memory(program, own.bindings, ignored, nullptr);
    std::size_t kept = 0;
    const auto remember = [&] {
        GroupMemory::Moment& now = made.moments.emplace_back();
        for (const std::span<std::uint32_t>& block : own.bindings.blocks)
            now.words.emplace_back(block.begin(), block.end());
        for (const TexelMemory& image : own.bindings.images)
            now.words.emplace_back(image.words.begin(), image.words.end());
        for (std::uint32_t w = 0; w < program.shared; ++w)
            now.shared.push_back(memory.load_shared(w, {}));
        for (const std::vector<std::uint32_t>& one : now.words)
            kept += one.size();
        if (kept + now.shared.size() > most_words)
            throw Error(fmt::format("group {}: its barriers are too many to keep what lies between them", group));
    };
    run_one_group(program, groups, own.bindings, profile, group, memory, remember);
    remember();
    return made;
}

std::vector<std::vector<GroupWrite>> group_writes(const Program& program, const std::array<std::uint32_t, 3>& groups,
                                                  const Bindings& bindings, const Profile& profile,
                                                  std::uint32_t group) {
    using Space = WrittenPlace::Space;
    const OwnBindings own(bindings);
    Findings ignored;
    std::vector<std::pair<WrittenPlace, std::uint32_t>> writes;
    Writers writers{.writes = &writes};
    Memory memory(program, own.bindings, ignored, nullptr, &writers);
    std::vector<std::vector<GroupWrite>> stretches;
    const auto gather = [&] {
        std::map<WrittenPlace, std::uint32_t> last(writes.begin(), writes.end());
        for (const auto& [place, by] : writes)
            last[place] = by;
        std::vector<GroupWrite>& now = stretches.emplace_back();
        for (const auto& [place, by] : last)
            now.push_back({place,
                           place.space == Space::shared ? memory.load_shared(static_cast<std::uint32_t>(place.word), {})
                           : place.space == Space::block ? own.bindings.blocks[place.number][place.word]
                                                         : own.bindings.images[place.number].words[place.word],
                           by});
        writes.clear();
    };
    bool is_first = true;
    run_one_group(program, groups, own.bindings, profile, group, memory, [&] {
        if (!std::exchange(is_first, false))
            gather();
    });
    gather();
    return stretches;
}

} // namespace lockstep::text
