#pragma once
#include "reference/fluid/depth_filter_twin.hpp"
#include "reference/fluid/normal_twin.hpp"
#include "reference/fluid/scene_twin.hpp"
#include "reference/fluid/shade_twin.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::fluid {

// What item_pass is told of a twin, and that it may go by lanes (lane_items.hpp) where these have what the switches
// ask.
ItemPassOptions by_lanes(ItemPassOptions options, const DepthFilterTwin& twin);
ItemPassOptions by_lanes(ItemPassOptions options, const NormalTwin& twin);
ItemPassOptions by_lanes(ItemPassOptions options, const ShadeTwin& twin);
ItemPassOptions by_lanes(ItemPassOptions options, const SceneTwin& twin);

/// A twin as a pass, by lanes where it may.
template <class Twin> std::unique_ptr<ItemPass> lane_pass(ItemPassOptions options, Twin twin) {
    options = by_lanes(std::move(options), twin);
    return item_pass(std::move(options), std::move(twin));
}

} // namespace lockstep::fluid
