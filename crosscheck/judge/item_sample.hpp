#pragma once
#include <cstddef>
#include <vector>

#include "crosscheck/judge/item_verdict.hpp"
#include "reference/model/state_view.hpp"

namespace lockstep {

/// At most `count` of them, evenly spread.
std::vector<std::size_t> sample(const std::vector<std::size_t>& all, std::size_t count);

/// Those that are unlike what most are: what is drawn, not the background. None where no two of a sample are alike.
std::vector<std::size_t> items_unlike_most(const View& items);

/// Those that no legal run explains, by index.
std::vector<std::size_t> divergent_items(const std::vector<ItemVerdict>& verdicts);

/// At most `most` of `count` items, of those that have no verdict: they do not differ.
std::vector<std::size_t> agreeing_items(std::size_t count, const std::vector<ItemVerdict>& verdicts, std::size_t most);

/// The same, and of those that differ by rounding alone.
std::vector<std::size_t> right_items(std::size_t count, const std::vector<ItemVerdict>& verdicts, std::size_t most);

} // namespace lockstep
