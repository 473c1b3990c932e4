#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "reference/lights/contribution.hpp"
#include "reference/model/lights/host.hpp"
#include "reference/model/system_state.hpp"

namespace lockstep::lights {

/// The order in which a voxel meets the lights that reach it, non-finite ones left out: by index; by cell, cells z, y,
/// x ascending, then by index (gather); or cells descending, then by index (blending, whose instances are the offsets
/// from a light's cell, ascending).
std::vector<std::uint32_t> light_order(const Host& host, const SystemView& state);

/// By clamped cell, ascending, then by index: what the pass light_sort_pass makes.
std::vector<std::uint32_t> by_cell(const Host& host, const SystemView& state);

/// The voxels at which the shader tries a light, of the grid or beside it, and the light's cell.
struct TriedVoxels {
    VoxelBox box;
    Voxel cell;
};

/// Those of each light of `order`: around its cell (gather, blending) or its ball.
std::vector<TriedVoxels> tried_voxels(const Host& host, const SystemView& state,
                                      const std::vector<std::uint32_t>& order);

/// Fewer of them, by mistake: the parts of Change::handed_over.
enum class FewerTried { two_short, own_column, next_rows, next_layers };
std::vector<TriedVoxels> mistaken_voxels(std::vector<TriedVoxels> tried, std::span<const Mistake> made);

} // namespace lockstep::lights
