#pragma once
#include <nlohmann/json_fwd.hpp>

#include "crosscheck/collision/judge/frame_run.hpp"
#include "crosscheck/collision/page/frame_keeper.hpp"

namespace lockstep {

/// What `lockstep explain` tells of an item, as data: verdict, rows with both sides' values, neighbourhood. Moves `run`
/// to the item's frame.
nlohmann::json explained(FrameRun& run, const PageItem& item);

} // namespace lockstep
