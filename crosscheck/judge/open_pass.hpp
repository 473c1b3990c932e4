#pragma once
#include <memory>

#include "reference/system/own_text.hpp"

namespace lockstep {

/// A pass of whose shader the own text is known. Where the text may legally give what the pass's reference may, all
/// that it may give is legal: a driver that takes another of its ways has made no mistake, and neither has its author.
/// Where the text leaves something open, the reference may be a formula that rounds elsewhere: then its sums, too, are
/// taken in any order.
std::unique_ptr<ItemPass> open_pass(std::unique_ptr<ItemPass> reference, std::shared_ptr<const OwnText> own);

} // namespace lockstep
