#pragma once
#include <memory>
#include <vector>

#include "reference/model/lights/host.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep::lights {

// The twins of a frame, in its order.
std::vector<std::unique_ptr<ItemPass>> twins(const HostPtr& host);

// Parts of it.
void add_scatter_passes(const HostPtr& host, std::vector<std::unique_ptr<ItemPass>>& all);
void add_gather_passes(const HostPtr& host, std::vector<std::unique_ptr<ItemPass>>& all);
void add_surface_passes(const HostPtr& host, std::vector<std::unique_ptr<ItemPass>>& all);
void add_image_passes(const HostPtr& host, std::vector<std::unique_ptr<ItemPass>>& all);

} // namespace lockstep::lights
