#include "crosscheck/judge/verdict_summary.hpp"

#include <algorithm>

namespace lockstep {
namespace {

void note_tie(std::map<TieKind, TieCount>& ties, const Tie& tie, const Place& place) {
    const auto [entry, is_new] = ties.try_emplace(tie.kind);
    TieCount& count = entry->second;
    if (is_new || tie.margin < count.smallest) {
        count.smallest = tie.margin;
        count.closest = place;
    }
    count.largest = std::max(count.largest, tie.margin);
    ++count.count;
}

} // namespace

void VerdictSummary::add(int frame, const FrameVerdicts& verdicts) {
    const auto note = [&](const ItemVerdict& verdict, bool texel, auto& counts) {
        ++counts[static_cast<std::size_t>(verdict.kind)];
        ++set_sizes[verdict.outcomes];
        if (verdict.tie)
            note_tie(ties, *verdict.tie, {frame, texel, verdict.index});
        if (verdict.kind == DifferenceClass::undefined)
            ++undefined[verdict.undefined];
    };
    for (const ItemVerdict& verdict : verdicts.particles)
        note(verdict, false, particles);
    for (const ItemVerdict& verdict : verdicts.texels)
        note(verdict, true, texels);
}

std::size_t VerdictSummary::median_set_size() const {
    std::uint64_t items = 0;
    for (const auto& [size, count] : set_sizes)
        items += count;
    std::uint64_t below = 0;
    for (const auto& [size, count] : set_sizes) {
        below += count;
        if (2 * below >= items)
            return size;
    }
    return 0;
}

std::optional<FirstDivergence> first_of(DifferenceClass kind, int frame, const JudgedFrame& judged,
                                        const FrameVerdicts& verdicts) {
    const auto find = [&](const std::vector<ItemVerdict>& items) {
        return std::find_if(items.begin(), items.end(), [&](const ItemVerdict& item) { return item.kind == kind; });
    };
    if (const auto found = find(verdicts.particles); found != verdicts.particles.end())
        return FirstDivergence{{frame, false, found->index}, *found, wrong_step_of_particle(judged, found->index)};
    if (const auto found = find(verdicts.texels); found != verdicts.texels.end())
        return FirstDivergence{{frame, true, found->index}, *found, wrong_step_of_texel(judged, found->index)};
    return {};
}

} // namespace lockstep
