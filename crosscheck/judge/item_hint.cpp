#include "crosscheck/judge/item_hint.hpp"

#include <algorithm>

#include "crosscheck/judge/item_judge.hpp"

namespace lockstep {
namespace {

bool is_within_rule(const ItemVerdict& verdict) { return verdict.kind < DifferenceClass::undefined; }

bool all_legal(const JudgedPass& pass, const std::vector<std::size_t>& items, Legal legal) {
    const KnownOperations known = known_operations(legal, pass.profile);
    const JudgedPass wider{pass.pass,      pass.profile, known,        pass.frame,   pass.before,
                           pass.reference, pass.gpu,     pass.earlier, pass.prepared};
    if (pass.pass.appended(pass.input())) { // an order is of all of them
        const std::vector<ItemVerdict> verdicts = judge_items(wider);
        return std::all_of(verdicts.begin(), verdicts.end(), is_within_rule);
    }
    return std::all_of(items.begin(), items.end(),
                       [&](std::size_t item) { return is_within_rule(judge_item(wider, item)); });
}

/// At most so many of them, from the first on, as far from one another as they can be.
std::vector<std::size_t> spread(const std::vector<std::size_t>& items, std::size_t most) {
    if (items.size() <= most)
        return items;
    std::vector<std::size_t> some(most);
    for (std::size_t i = 0; i < most; ++i)
        some[i] = items[i * items.size() / most];
    return some;
}

} // namespace

void ItemHint::add(const JudgedPass& pass, const std::vector<ItemVerdict>& verdicts) {
    if (!by_any_order_)
        return;
    std::vector<std::size_t> divergent;
    for (const ItemVerdict& v : verdicts)
        if (v.kind == DifferenceClass::divergent)
            divergent.push_back(v.index);
    if (divergent.empty())
        return;
    const std::vector<std::size_t> tried = spread(divergent, runs_ < first_runs ? tried_at_first : tried_later);
    ++runs_;
    by_glsl_ = by_glsl_ && all_legal(pass, tried, Legal::glsl);
    by_any_order_ = by_glsl_ || all_legal(pass, tried, Legal::any_order);
}

std::optional<Legal> ItemHint::rule() const {
    if (runs_ == 0 || !by_any_order_)
        return {};
    return by_glsl_ ? Legal::glsl : Legal::any_order;
}

} // namespace lockstep
