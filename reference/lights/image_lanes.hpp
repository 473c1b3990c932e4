#pragma once
#include "reference/lights/lighting_twin.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::lights {

// What item_pass is told of a twin, and that it goes by lanes (lane_items.hpp).
ItemPassOptions by_lanes(ItemPassOptions options, const DrawnTwin& twin);
ItemPassOptions by_lanes(ItemPassOptions options, const DeferredTwin& twin);

/// A twin as a pass, by lanes.
template <class Twin> std::unique_ptr<ItemPass> lane_pass(ItemPassOptions options, Twin twin) {
    options = by_lanes(std::move(options), twin);
    return item_pass(std::move(options), std::move(twin));
}

} // namespace lockstep::lights
