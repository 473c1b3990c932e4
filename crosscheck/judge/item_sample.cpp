#include "crosscheck/judge/item_sample.hpp"

namespace lockstep {

std::vector<std::size_t> sample(const std::vector<std::size_t>& all, std::size_t count) {
    if (all.size() <= count)
        return all;
    std::vector<std::size_t> some(count);
    for (std::size_t i = 0; i < count; ++i)
        some[i] = all[i * all.size() / count];
    return some;
}

std::vector<std::size_t> divergent_items(const std::vector<ItemVerdict>& verdicts) {
    std::vector<std::size_t> items;
    for (const ItemVerdict& verdict : verdicts)
        if (verdict.kind == DifferenceClass::divergent)
            items.push_back(verdict.index);
    return items;
}

namespace {

/// At most `most` of `count` items without a verdict, or with one that `counts`.
template <class Counts> std::vector<std::size_t>
items_beside(std::size_t count, const std::vector<ItemVerdict>& verdicts, std::size_t most, const Counts& counts) {
    std::vector<std::size_t> items;
    for (std::size_t i = 0, next = 0; i < count; ++i) {
        const bool differs = next < verdicts.size() && verdicts[next].index == i;
        if (!differs || counts(verdicts[next]))
            items.push_back(i);
        next += differs ? 1U : 0U;
    }
    return sample(items, most);
}

} // namespace

std::vector<std::size_t> agreeing_items(std::size_t count, const std::vector<ItemVerdict>& verdicts, std::size_t most) {
    return items_beside(count, verdicts, most, [](const ItemVerdict&) { return false; });
}

std::vector<std::size_t> right_items(std::size_t count, const std::vector<ItemVerdict>& verdicts, std::size_t most) {
    return items_beside(count, verdicts, most,
                        [](const ItemVerdict& verdict) { return verdict.kind == DifferenceClass::rounding; });
}

} // namespace lockstep
