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

VerdictSummary::VerdictSummary(const Schema& schema)
    : classes(schema.resources.size()), causes(schema.resources.size()) {
    for (std::size_t r = 0; r < schema.resources.size(); ++r)
        widths.emplace_back(schema, static_cast<std::uint8_t>(r));
}

bool is_tie_beyond_rounding(const ItemVerdict& verdict) {
    return verdict.kind == DifferenceClass::tie && verdict.lean && verdict.lean->beyond_rounding;
}

void VerdictSummary::add(int frame, std::uint8_t resource, std::span<const ItemVerdict> verdicts) {
    for (const ItemVerdict& verdict : verdicts) {
        ++classes[resource][static_cast<std::size_t>(verdict.kind)];
        ++set_sizes[verdict.outcomes];
        if (verdict.kind < DifferenceClass::undefined && !verdict.sets.empty())
            widths[resource].add(frame, verdict.index, verdict.sets);
        if (verdict.tie)
            note_tie(ties, *verdict.tie, {frame, resource, verdict.index});
        if (verdict.lean) {
            leans.add(*verdict.lean);
            ties_beyond_rounding += is_tie_beyond_rounding(verdict) ? 1 : 0;
        }
        if (verdict.kind == DifferenceClass::undefined)
            ++undefined[verdict.undefined];
        if (verdict.kind == DifferenceClass::divergent &&
            (divergent_frames.empty() || divergent_frames.back() != frame))
            divergent_frames.push_back(frame);
    }
}

void VerdictSummary::join(const VerdictSummary& next) {
    for (std::size_t r = 0; r < classes.size(); ++r)
        for (std::size_t kind = 0; kind < class_names.size(); ++kind)
            classes[r][kind] += next.classes[r][kind];
    for (const auto& [size, count] : next.set_sizes)
        set_sizes[size] += count;
    for (std::size_t r = 0; r < widths.size(); ++r)
        widths[r].join(next.widths[r]);
    for (const auto& [kind, tie] : next.ties) {
        const auto [entry, is_new] = ties.try_emplace(kind, tie);
        if (is_new)
            continue;
        TieCount& known = entry->second;
        if (tie.smallest < known.smallest) {
            known.smallest = tie.smallest;
            known.closest = tie.closest;
        }
        known.largest = std::max(known.largest, tie.largest);
        known.count += tie.count;
    }
    for (const auto& [reason, count] : next.undefined)
        undefined[reason] += count;
    for (const Lean& lean : next.leans.counted())
        leans.add(lean);
    ties_beyond_rounding += next.ties_beyond_rounding;
    if (!first_beyond_rounding)
        first_beyond_rounding = next.first_beyond_rounding;
    if (!first || (divergent_frames.empty() && !next.divergent_frames.empty()))
        first = next.first;
    if (divergent_frames.empty())
        causes = next.causes;
    else if (!next.divergent_frames.empty())
        causes.assign(causes.size(), {});
    divergent_frames.insert(divergent_frames.end(), next.divergent_frames.begin(), next.divergent_frames.end());
}

std::uint64_t VerdictSummary::total(DifferenceClass kind) const {
    std::uint64_t sum = 0;
    for (const Counts& counts : classes)
        sum += counts[static_cast<std::size_t>(kind)];
    return sum;
}

std::string VerdictSummary::convicted_shift() const {
    return judges_leans ? leans.shift([&](Leans::Direction d) { return leans.one_sided(d); }) : "";
}

void VerdictSummary::convict_shift() {
    if (!first_beyond_rounding || convicted_shift().empty())
        return;
    Counts& drawn = classes[first_beyond_rounding->place.resource];
    drawn[static_cast<std::size_t>(DifferenceClass::tie)] -= ties_beyond_rounding;
    drawn[static_cast<std::size_t>(DifferenceClass::divergent)] += ties_beyond_rounding;
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

} // namespace lockstep
