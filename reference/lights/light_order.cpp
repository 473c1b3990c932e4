#include "reference/lights/light_order.hpp"

#include <algorithm>
#include <tuple>

namespace lockstep::lights {
namespace {

std::vector<std::uint32_t> finite_lights(const SystemView& state) {
    std::vector<std::uint32_t> all;
    for (std::uint32_t i = 0; i < state[light_buffer].count(); ++i)
        if (is_finite_light(state, i))
            all.push_back(i);
    return all;
}

} // namespace

std::vector<std::uint32_t> by_cell(const Host& host, const SystemView& state) {
    std::vector<std::uint32_t> all = finite_lights(state);
    std::vector<std::size_t> cell(state[light_buffer].count());
    for (const std::uint32_t i : all)
        cell[i] =
            clamped_cell(host.grid(), cell_of(host.grid(), state.vec3(field::light_position, i))).index(host.grid());
    std::stable_sort(all.begin(), all.end(), [&](std::uint32_t a, std::uint32_t b) { return cell[a] < cell[b]; });
    return all;
}

std::vector<std::uint32_t> light_order(const Host& host, const SystemView& state) {
    if (host.switches().accumulate == Accumulate::gather)
        return by_cell(host, state);
    std::vector<std::uint32_t> all = finite_lights(state);
    if (!blends(host.switches().accumulate))
        return all;
    std::vector<std::tuple<int, int, int>> cell(state[light_buffer].count());
    for (const std::uint32_t i : all) {
        const Voxel v = cell_of(host.grid(), state.vec3(field::light_position, i));
        cell[i] = {v.z, v.y, v.x};
    }
    std::stable_sort(all.begin(), all.end(), [&](std::uint32_t a, std::uint32_t b) { return cell[a] > cell[b]; });
    return all;
}

std::vector<TriedVoxels> tried_voxels(const Host& host, const SystemView& state,
                                      const std::vector<std::uint32_t>& order) {
    const Accumulate how = host.switches().accumulate;
    std::vector<TriedVoxels> all;
    for (const std::uint32_t light : order) {
        Voxel cell = cell_of(host.grid(), state.vec3(field::light_position, light));
        if (scatters(how)) {
            all.push_back({unbounded_box(host, state, light), cell});
            continue;
        }
        if (!blends(how))
            cell = clamped_cell(host.grid(), cell);
        const int m = host.reach();
        all.push_back({{{cell.x - m, cell.y - m, cell.z - m}, {cell.x + m, cell.y + m, cell.z + m}}, cell});
    }
    return all;
}

std::vector<TriedVoxels> mistaken_voxels(std::vector<TriedVoxels> tried, std::span<const Mistake> made) {
    for (const Mistake& mistake : made)
        for (TriedVoxels& one : tried) {
            VoxelBox& box = one.box;
            if (mistake.change != Change::handed_over)
                continue;
            switch (static_cast<FewerTried>(mistake.part)) {
            case FewerTried::two_short:
                box.high = {box.high.x - 2, box.high.y - 2, box.high.z - 2};
                break;
            case FewerTried::own_column:
                box.low.x = box.high.x = one.cell.x;
                break;
            case FewerTried::next_rows:
                box.high.y = one.cell.y + 1;
                break;
            case FewerTried::next_layers:
                box.high.z = one.cell.z + 1;
                break;
            }
        }
    return tried;
}

} // namespace lockstep::lights
