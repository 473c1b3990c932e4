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

bool is_tie_beyond_rounding(const ItemVerdict& verdict) {
    return verdict.kind == DifferenceClass::tie && verdict.lean && verdict.lean->beyond_rounding;
}

} // namespace

void VerdictSummary::add(int frame, const FrameVerdicts& verdicts) {
    const auto note = [&](const ItemVerdict& verdict, bool texel, auto& counts) {
        ++counts[static_cast<std::size_t>(verdict.kind)];
        ++set_sizes[verdict.outcomes];
        if (verdict.tie)
            note_tie(ties, *verdict.tie, {frame, texel, verdict.index});
        if (verdict.lean) {
            leans.add(*verdict.lean);
            ties_beyond_rounding += is_tie_beyond_rounding(verdict) ? 1 : 0;
        }
        if (verdict.kind == DifferenceClass::undefined)
            ++undefined[verdict.undefined];
    };
    for (const ItemVerdict& verdict : verdicts.particles)
        note(verdict, false, particles);
    for (const ItemVerdict& verdict : verdicts.texels)
        note(verdict, true, texels);
}

std::string VerdictSummary::convicted_shift() const {
    return judges_leans ? leans.shift([&](Leans::Direction d) { return leans.one_sided(d); }) : "";
}

void VerdictSummary::convict_shift() {
    if (convicted_shift().empty())
        return;
    texels[static_cast<std::size_t>(DifferenceClass::tie)] -= ties_beyond_rounding;
    texels[static_cast<std::size_t>(DifferenceClass::divergent)] += ties_beyond_rounding;
    ties_beyond_rounding = 0;
    if (!first || first->verdict.kind != DifferenceClass::divergent)
        first = first_beyond_rounding;
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

bool can_judge_leans(const KnownOperations& known, const Profile& profile) {
    const KnownRaster& raster = known.raster;
    return raster.point_grid && raster.point_edges && raster.triangle_grid && raster.triangle_sides &&
           profile.point_window_accurate != false && profile.corner_window_accurate != false;
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

std::optional<FirstDivergence> first_tie_beyond_rounding(int frame, const JudgedFrame& judged,
                                                         const FrameVerdicts& verdicts) {
    const auto found = std::find_if(verdicts.texels.begin(), verdicts.texels.end(), is_tie_beyond_rounding);
    if (found == verdicts.texels.end())
        return {};
    ItemVerdict convicted = *found;
    convicted.kind = DifferenceClass::divergent;
    convicted.tie = std::nullopt;
    return FirstDivergence{{frame, true, found->index}, convicted, wrong_step_of_texel(judged, found->index)};
}

} // namespace lockstep
