#include "crosscheck/text/group_witness.hpp"

#include <algorithm>
#include <map>
#include <set>
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
                                      std::optional<std::size_t> stretch) {
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

/// The groups of a text that are asked for.
class Groups {
  public:
    explicit Groups(const BoundStage& stage) : stage_(stage) {}
    [[nodiscard]] RememberedGroup& of(std::uint32_t group) {
        const auto found = groups_.find(group);
        return found != groups_.end() ? found->second : groups_.try_emplace(group, stage_, group).first->second;
    }
    /// Of an invocation of any group, in a stretch or as a whole. Refers to this.
    [[nodiscard]] auto runs(std::optional<std::size_t> stretch) {
        return [this, stretch](std::uint32_t invocation, std::span<const text::ForcedRow> forced) {
            return of(invocation / stage_.program.invocations()).run(invocation, forced, stretch);
        };
    }

  private:
    const BoundStage& stage_;
    std::map<std::uint32_t, RememberedGroup> groups_;
};

/// Whether each has the other's shared variables, and barriers where the other has.
bool share_alike(const text::Program& a, const text::Program& b) {
    const auto has_all = [](const text::Program& one, const text::Program& other) {
        return std::ranges::all_of(other.shared_names, [&](const text::NamedCells& named) {
            return std::ranges::find(one.shared_names, named.name, &text::NamedCells::name) != one.shared_names.end();
        });
    };
    return (a.barriers > 0) == (b.barriers > 0) && has_all(a, b) && has_all(b, a);
}

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
               return (step.op == text::code::atomic_block || step.op == text::code::atomic_texel) &&
                      step.out != text::no_cell;
           });
}

std::vector<WitnessLine> group_witness_lines(const SharingText& wrong, const SharingText& reference,
                                             std::span<const ItemWriters> items, std::span<const ItemWriters> others,
                                             const Common& common,
                                             const std::function<bool(std::string_view where)>& is_own) try {
    constexpr std::size_t most_groups = 3, most_items = 10;
    Groups groups_of_wrong(wrong.stage), groups_of_reference(reference.stage);
    const Common all_of_reference = [&](const text::WrittenPlace& place) {
        return place.space == Space::shared ? common_shared(reference.stage.program, wrong.stage.program, place)
                                            : common(place);
    };
    std::set<std::uint32_t> groups;
    for (const ItemWriters& by : items)
        if (const auto one = by.wrong ? by.wrong : by.reference; one && groups.size() < most_groups)
            groups.insert(*one / wrong.stage.program.invocations());
    for (const std::uint32_t group : groups) {
        if (!share_alike(wrong.stage.program, reference.stage.program))
            break;
        RememberedGroup &own = groups_of_wrong.of(group), &right = groups_of_reference.of(group);
        if (own.memory.moments.size() != right.memory.moments.size())
            break;
        const std::optional<std::size_t> stretch = wrong_stretch(own, right, all_of_reference);
        if (!stretch)
            continue;
        const WitnessedText of_wrong{wrong.stage.program, groups_of_wrong.runs(stretch),
                                     [](const text::WrittenPlace&p) { return std::optional(p); }, wrong.source},
            of_reference{reference.stage.program, groups_of_reference.runs(stretch), all_of_reference,
                         reference.source};
        std::vector<ItemWriters> in_stretch, same;
        const std::uint32_t size = wrong.stage.program.invocations();
        for (std::uint32_t i = group * size; i < (group + 1) * size; ++i) {
            std::vector<ItemWriters>& to =
                common_run(of_wrong, i).words == common_run(of_reference, i).words ? same : in_stretch;
            if (to.size() < most_items)
                to.push_back({i, i});
        }
        std::vector<WitnessLine> lines = witness_lines(of_wrong, of_reference, in_stretch, same, is_own);
        if (!lines.empty())
            return lines;
    }
    const Common no_shared = [](const text::WrittenPlace& place) {
        return place.space == Space::shared ? std::nullopt : std::optional(place);
    };
    std::vector<WitnessLine> lines = witness_lines(
        {wrong.stage.program, groups_of_wrong.runs({}), no_shared, wrong.source},
        {reference.stage.program, groups_of_reference.runs({}),
         [&](const text::WrittenPlace& place) { return place.space == Space::shared ? std::nullopt : common(place); },
         reference.source},
        items, others, is_own, true);
    if (shares(reference.stage.program)) // what it makes of others' words lies behind what went wrong
        std::erase_if(lines, [](const WitnessLine& one) { return one.where.ends_with(reference_mark); });
    return lines;
} catch (const Error&) {
    return {}; // too many barriers, or what is not run so
}

} // namespace lockstep
