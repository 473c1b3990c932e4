#pragma once
#include <cstdint>
#include <vector>

#include "reference/model/lights/host.hpp"
#include "reference/model/system_state.hpp"

namespace lockstep::lights {

/// The order in which a voxel meets the lights that reach it, non-finite ones left out: by index; by cell, cells z, y,
/// x ascending, then by index (gather); or cells descending, then by index (blending, whose instances are the offsets
/// from a light's cell, ascending).
std::vector<std::uint32_t> light_order(const Host& host, const SystemView& state);

/// By clamped cell, ascending, then by index: what the pass light_sort_pass makes.
std::vector<std::uint32_t> by_cell(const Host& host, const SystemView& state);

} // namespace lockstep::lights
