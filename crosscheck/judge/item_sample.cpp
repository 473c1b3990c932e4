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

std::vector<std::size_t> agreeing_items(std::size_t count, const std::vector<ItemVerdict>& verdicts, std::size_t most) {
    std::vector<std::size_t> items;
    for (std::size_t i = 0, next = 0; i < count; ++i) {
        if (next < verdicts.size() && verdicts[next].index == i)
            ++next;
        else
            items.push_back(i);
    }
    return sample(items, most);
}

} // namespace lockstep
