#pragma once
#include <memory>
#include <vector>

#include "reference/model/dust/host.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep::dust {

// The kernels' twins as passes.
std::unique_ptr<ItemPass> populate_pass(const HostPtr& host);
std::unique_ptr<ItemPass> vacuum_up_pass(const HostPtr& host);
std::unique_ptr<ItemPass> emit_pass(const HostPtr& host);
std::unique_ptr<ItemPass> blow_wind_pass(const HostPtr& host);
std::unique_ptr<ItemPass> explode_pass(const HostPtr& host, std::size_t ball);
std::unique_ptr<ItemPass> update_pass(const HostPtr& host);
/// How many grains are alive once `kernel` ran.
std::unique_ptr<ItemPass> count_pass(const ItemPass& kernel);

/// All of a frame, in the order of frame_order(), each kernel with its count.
std::vector<std::unique_ptr<ItemPass>> twins(const HostPtr& host);

} // namespace lockstep::dust
