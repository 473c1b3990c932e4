#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "reference/model/fluid/host.hpp"
#include "reference/model/fluid/schema.hpp"
#include "reference/system/item_pass.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep::fluid {

using Passes = std::vector<std::unique_ptr<ItemPass>>;

// The twins of a frame, in its order.
Passes twins(const HostPtr& host);

// Parts of it.
void add_scene_passes(const HostPtr& host, Passes& all);
void add_sphere_pass(const HostPtr& host, Passes& all);
void add_filter_passes(const HostPtr& host, Passes& all);
void add_normal_pass(const HostPtr& host, Passes& all);
void add_thickness_passes(const HostPtr& host, Passes& all);
void add_shade_passes(const HostPtr& host, Passes& all);

inline ItemPassOptions options_of(const Host& host, const char* name, std::uint8_t resource, PassStage stage) {
    return {.name = name, .resource = resource, .stage = stage, .arithmetic = host.settings().arithmetic};
}

} // namespace lockstep::fluid
