#pragma once
#include <memory>

#include "reference/model/lifecycle/drawing.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep::lifecycle {

/// The vertex stage that draws sprites and ribbons, as a pass that makes the corners of drawn_schema().
std::unique_ptr<ItemPass> draw_pass(const HostPtr& host, const Drawing& drawing);

} // namespace lockstep::lifecycle
