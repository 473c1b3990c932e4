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

} // namespace

void ItemHint::add(const JudgedPass& pass, const std::vector<ItemVerdict>& verdicts) {
    if (!by_any_order_)
        return;
    std::vector<std::size_t> tried;
    const std::size_t most = runs_ < first_runs ? tried_at_first : tried_later;
    for (auto v = verdicts.begin(); v != verdicts.end() && tried.size() < most; ++v)
        if (v->kind == DifferenceClass::divergent)
            tried.push_back(v->index);
    if (tried.empty())
        return;
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
