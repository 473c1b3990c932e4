#include "reference/lights/light_order.hpp"

#include <algorithm>
#include <tuple>

#include "reference/lights/contribution.hpp"

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

} // namespace lockstep::lights
