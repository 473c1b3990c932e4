#include "crosscheck/judge/item_judge.hpp"

#include <algorithm>
#include <optional>

#include "crosscheck/judge/append_judge.hpp"
#include "crosscheck/judge/compare.hpp"
#include "crosscheck/judge/legal_widths.hpp"
#include "reference/parallel_blocks.hpp"

namespace lockstep {
bool same_item(const View& a, const View& b, std::size_t item) {
    const std::vector<Component> parts = components(a.about());
    return std::all_of(parts.begin(), parts.end(), [&](const Component& c) {
        return same_bits(a.value(c.field, item, c.component), b.value(c.field, item, c.component));
    });
}

namespace {

/// The sets of the first outcome that has the reference's own numbers; none where all are points.
std::vector<Interval> sets_of_reference(const std::vector<ItemOutcome>& outcomes, const JudgedPass& p,
                                        std::size_t item) {
    const auto own =
        std::ranges::find_if(outcomes, [&](const ItemOutcome& outcome) { return outcome.contains(p.reference, item); });
    if (own == outcomes.end() || own->undefined != Undefined::none ||
        std::ranges::all_of(own->values, [](const Interval& set) { return width_of(set) == 0.0; }))
        return {};
    return own->values;
}

} // namespace

ItemVerdict judge_item(const JudgedPass& p, std::size_t item) {
    const auto outcomes = p.on_input().outcomes(p.input(), item, p.profile, p.known, &p.gpu);
    ItemVerdict verdict{.index = item, .outcomes = outcomes.size()};
    std::vector<ItemOutcome> untold; // where no value of the GPU's was gone on from
    for (const ItemOutcome& outcome : outcomes) {
        if (!outcome.contains(p.gpu, item))
            continue;
        DifferenceClass kind = DifferenceClass::rounding;
        if (outcome.undefined != Undefined::none) {
            kind = DifferenceClass::undefined;
        } else if (outcomes.size() > 1 && !outcome.open.empty()) {
            if (untold.empty())
                untold = p.on_input().outcomes(p.input(), item, p.profile, p.known, nullptr);
            const bool alike = std::any_of(untold.begin(), untold.end(), [&](const ItemOutcome& one) {
                return one.contains(p.gpu, item) && one.contains(p.reference, item);
            });
            kind = alike ? DifferenceClass::rounding : DifferenceClass::tie;
        }
        if (kind >= verdict.kind)
            continue;
        verdict.kind = kind;
        verdict.undefined = outcome.undefined;
        verdict.sets = kind == DifferenceClass::undefined ? std::vector<Interval>() : outcome.values;
        verdict.tie = std::nullopt;
        if (kind == DifferenceClass::tie && !outcome.open.empty())
            verdict.tie = Tie{{outcome.open.front().site, outcome.open.front().unit}, outcome.open.front().margin};
    }
    if (verdict.kind == DifferenceClass::divergent)
        verdict.sets = sets_of_reference(outcomes, p, item);
    return verdict;
}

std::vector<ItemVerdict> judge_items(const JudgedPass& pass) {
    if (pass.pass.appended(pass.input()))
        return judge_appended(pass);
    const std::vector<std::size_t> differing = differing_items(pass.reference, pass.gpu);
    std::vector<ItemVerdict> verdicts(differing.size());
    constexpr std::size_t block = 16;
    const auto blocks = static_cast<std::ptrdiff_t>((differing.size() + block - 1) / block);
    parallel_blocks(blocks, [&](std::ptrdiff_t b) {
        const std::size_t first = static_cast<std::size_t>(b) * block;
        for (std::size_t i = first; i < std::min(first + block, differing.size()); ++i)
            verdicts[i] = judge_item(pass, differing[i]);
    });
    return verdicts;
}

} // namespace lockstep
