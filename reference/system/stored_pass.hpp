#pragma once
#include <memory>
#include <vector>

#include "reference/system/item_pass.hpp"

namespace lockstep {

/// The passes as their images store what the twins make: floats of an image of halves are converted as the probe
/// measured it of draws, or of imageStore (reference/paired_rows.hpp), and to either neighbour where it did not. What
/// is a half already stays. Passes whose sums are in no order round each addend, which their twins say themselves;
/// they, and passes of other formats, are those of `made`, which outlive this.
std::vector<std::shared_ptr<const ItemPass>> stored_passes(const std::vector<std::unique_ptr<ItemPass>>& made,
                                                           const Schema& schema);
std::shared_ptr<const ItemPass> stored_pass(const ItemPass& made, const Schema& schema);

} // namespace lockstep
