#include "crosscheck/text/group_witness.hpp"

#include <algorithm>
#include <utility>

#include "reference/model/error.hpp"
#include "reference/text/group_memory.hpp"

namespace lockstep {
namespace {

using Space = text::WrittenPlace::Space;
using Common = std::function<std::optional<text::WrittenPlace>(text::WrittenPlace)>;

/// A group of a text, and what lies in memory between its barriers.
struct RememberedGroup {
    const BoundStage& stage;
    text::GroupMemory memory;

    RememberedGroup(const BoundStage& of, std::uint32_t group)
        : stage(of), memory(text::remembered_group(of.program, of.groups, of.bindings, of.profile, group)) {}

    [[nodiscard]] text::TracedRun run(std::uint32_t invocation, std::span<const text::ForcedRow> forced,
                                      std::size_t stretch) {
        text::TracedRun made;
        made.words = text::run_traced_in_group(stage.program, stage.invocation(invocation), stage.groups,
                                               stage.bindings, stage.profile, forced, made.trace, memory, stretch);
        return made;
    }
    [[nodiscard]] std::optional<std::uint32_t> word(std::size_t moment, const text::WrittenPlace& place) const {
        const text::GroupMemory::Moment& now = memory.moments[moment];
        const std::vector<std::uint32_t>& words = place.space == Space::shared ? now.shared
                                                  : place.space == Space::block
                                                      ? now.words[place.number]
                                                      : now.words[stage.program.blocks.size() + place.number];
        return place.word < words.size() ? std::optional(words[place.word]) : std::nullopt;
    }
};

/// The same shared variable of another text.
std::optional<text::WrittenPlace> common_shared(const text::Program& of, const text::Program& other,
                                                text::WrittenPlace place) {
    for (const text::NamedCells& one : of.shared_names)
        if (place.word >= one.first && place.word < one.first + one.count) {
            const auto same = std::ranges::find(other.shared_names, one.name, &text::NamedCells::name);
            if (same == other.shared_names.end() || place.word - one.first >= same->count)
                return {};
            place.word = place.word - one.first + same->first;
            return place;
        }
    return {};
}

/// Whether a moment has other words in two groups, where both have them.
bool differ(const RememberedGroup& wrong, const RememberedGroup& right, std::size_t moment, const Common& common) {
    const auto differs_at = [&](const text::WrittenPlace& place) {
        const std::optional<text::WrittenPlace> own = common(place);
        return own && wrong.word(moment, *own) != right.word(moment, place);
    };
    const text::GroupMemory::Moment& now = right.memory.moments[moment];
    const std::size_t blocks = right.stage.program.blocks.size();
    for (std::uint32_t k = 0; k < now.words.size(); ++k)
        for (std::size_t w = 0; w < now.words[k].size(); ++w)
            if (differs_at({k < blocks ? Space::block : Space::texel,
                            static_cast<std::uint32_t>(k < blocks ? k : k - blocks), w}))
                return true;
    for (std::size_t w = 0; w < now.shared.size(); ++w)
        if (differs_at({Space::shared, 0, w}))
            return true;
    return false;
}

/// The first stretch behind which memory differs; nothing: none.
std::optional<std::size_t> wrong_stretch(const RememberedGroup& wrong, const RememberedGroup& right,
                                         const Common& common) {
    const std::size_t moments = std::min(wrong.memory.moments.size(), right.memory.moments.size());
    for (std::size_t moment = 1; moment < moments; ++moment)
        if (differ(wrong, right, moment, common))
            return moment - 1;
    return {};
}

} // namespace

bool shares(const text::Program& program) {
    return program.barriers > 0 || program.shared > 0 || std::ranges::any_of(program.steps, [](const text::Step& step) {
               return step.op == text::code::atomic_shared || step.op == text::code::atomic_block ||
                      step.op == text::code::atomic_texel;
           });
}

std::vector<WitnessLine>
group_witness_lines(const BoundStage& wrong, const BoundStage& reference, std::span<const std::uint32_t> groups,
                    const Common& common, const std::function<std::string(std::uint32_t line)>& line_of_wrong,
                    const std::function<std::string(std::uint32_t line)>& line_of_reference) try {
    constexpr std::size_t most_items = 10;
    const Common common_of_reference = [&](const text::WrittenPlace& place) {
        return place.space == Space::shared ? common_shared(reference.program, wrong.program, place) : common(place);
    };
    for (const std::uint32_t group : groups) {
        RememberedGroup own(wrong, group), right(reference, group);
        const std::optional<std::size_t> stretch = wrong_stretch(own, right, common_of_reference);
        if (!stretch)
            continue;
        const auto runs_of = [&](RememberedGroup& of) {
            return [&of, stretch](std::uint32_t invocation, std::span<const text::ForcedRow> forced) {
                return of.run(invocation, forced, *stretch);
            };
        };
        const WitnessedText of_wrong{wrong.program, runs_of(own),
                                     [](const text::WrittenPlace&p) { return std::optional(p); }, line_of_wrong},
            of_reference{reference.program, runs_of(right), common_of_reference, line_of_reference};
        std::vector<ItemWriters> items, others;
        const std::uint32_t size = wrong.program.invocations();
        for (std::uint32_t i = group * size; i < (group + 1) * size; ++i) {
            std::vector<ItemWriters>& to =
                common_run(of_wrong, i).words == common_run(of_reference, i).words ? others : items;
            if (to.size() < most_items)
                to.push_back({i, i});
        }
        std::vector<WitnessLine> lines =
            witness_lines(of_wrong, of_reference, items, others, [](std::string_view) { return true; });
        if (!lines.empty())
            return lines;
    }
    return {};
} catch (const Error&) {
    return {}; // too many barriers, or what is not run so
}

} // namespace lockstep
