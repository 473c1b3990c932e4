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

bool is_tie_beyond_rounding(const ItemVerdict& verdict) {
    return verdict.kind == DifferenceClass::tie && verdict.lean && verdict.lean->beyond_rounding;
}

void VerdictSummary::add(int frame, std::uint8_t resource, std::span<const ItemVerdict> verdicts) {
    for (const ItemVerdict& verdict : verdicts) {
        ++classes[resource][static_cast<std::size_t>(verdict.kind)];
        ++set_sizes[verdict.outcomes];
        if (verdict.tie)
            note_tie(ties, *verdict.tie, {frame, resource, verdict.index});
        if (verdict.lean) {
            leans.add(*verdict.lean);
            ties_beyond_rounding += is_tie_beyond_rounding(verdict) ? 1 : 0;
        }
        if (verdict.kind == DifferenceClass::undefined)
            ++undefined[verdict.undefined];
    }
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
    if (convicted_shift().empty())
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
