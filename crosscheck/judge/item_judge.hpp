#pragma once
#include <cstddef>
#include <vector>

#include "crosscheck/judge/item_verdict.hpp"
#include "crosscheck/judge/system.hpp"

namespace lockstep {

/// Whether all of an item's words are the same, NaN being one value.
bool same_item(const View& a, const View& b, std::size_t item);

/// The verdict on one item, whether it differs or not. It is legal when all of its fields lie in one legal outcome of
/// its step; a tie where that is an outcome which the reference's own values do not lie in.
ItemVerdict judge_item(const JudgedPass& pass, std::size_t item);

/// Verdicts on the items that are not bit-equal, by index.
std::vector<ItemVerdict> judge_items(const JudgedPass& pass);

} // namespace lockstep
