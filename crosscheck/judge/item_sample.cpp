#include "crosscheck/judge/item_sample.hpp"

#include <algorithm>
#include <cstring>

namespace lockstep {

std::vector<std::size_t> sample(const std::vector<std::size_t>& all, std::size_t count) {
    if (all.size() <= count)
        return all;
    std::vector<std::size_t> some(count);
    for (std::size_t i = 0; i < count; ++i)
        some[i] = all[i * all.size() / count];
    return some;
}

std::vector<std::size_t> items_unlike_most(const View& items) {
    constexpr std::size_t asked = 64;
    const auto are_alike = [&](std::size_t a, std::size_t b) {
        for (std::size_t f = 0; f < items.columns.size(); ++f) {
            const std::size_t bytes = static_cast<std::size_t>(items.fields()[f].components) * sizeof(std::uint32_t);
            if (items.columns[f] != nullptr &&
                std::memcmp(items.columns[f] + a * bytes, items.columns[f] + b * bytes, bytes) != 0)
                return false;
        }
        return true;
    };
    const std::size_t some = std::min(asked, items.count());
    std::size_t commonest = 0;
    std::ptrdiff_t most = 1;
    std::vector<std::size_t> tried(some);
    for (std::size_t i = 0; i < some; ++i)
        tried[i] = i * items.count() / some;
    for (const std::size_t item : tried) {
        const auto alike = std::ranges::count_if(tried, [&](std::size_t other) { return are_alike(item, other); });
        if (alike > most) {
            most = alike;
            commonest = item;
        }
    }
    std::vector<std::size_t> unlike;
    for (std::size_t i = 0; i < items.count() && most > 1; ++i)
        if (!are_alike(i, commonest))
            unlike.push_back(i);
    return unlike;
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
