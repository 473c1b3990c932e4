#include "reference/lights/light_order.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace lockstep::lights {
namespace {

std::vector<std::uint32_t> finite_lights(const SystemView& state) {
    std::vector<std::uint32_t> all;
    for (std::uint32_t i = 0; i < state[light_buffer].count(); ++i)
        if (is_finite_light(state, i))
            all.push_back(i);
    return all;
}

constexpr int block_side = 4; ///< voxels

std::vector<TriedVoxels> voxels_of(const Host& host, const SystemView& state, const std::vector<std::uint32_t>& order) {
    const Accumulate how = host.switches().accumulate;
    std::vector<TriedVoxels> all;
    all.reserve(order.size());
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

void take_away(FewerTried fewer, TriedVoxels& of) {
    VoxelBox& box = of.box;
    switch (fewer) {
    case FewerTried::two_short:
        box.high = {box.high.x - 2, box.high.y - 2, box.high.z - 2};
        break;
    case FewerTried::own_column:
        box.low.x = box.high.x = of.cell.x;
        break;
    case FewerTried::next_rows:
        box.high.y = of.cell.y + 1;
        break;
    case FewerTried::next_layers:
        box.high.z = of.cell.z + 1;
        break;
    }
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

TriedLights::TriedLights(const Host& host, const SystemView& state, const std::vector<std::uint32_t>& order)
    : grid_(host.grid().size), voxels_(std::make_shared<const std::vector<TriedVoxels>>(voxels_of(host, state, order))),
      made_once_(std::make_shared<MadeOnce>()) {}

TriedLights TriedLights::mistaken(std::span<const Mistake> made) const {
    TriedLights fewer = *this;
    for (const Mistake& mistake : made) {
        if (mistake.change != Change::handed_over)
            continue;
        std::vector<TriedVoxels> all = *fewer.voxels_;
        for (TriedVoxels& one : all)
            take_away(static_cast<FewerTried>(mistake.part), one);
        fewer.voxels_ = std::make_shared<const std::vector<TriedVoxels>>(std::move(all));
    }
    return fewer;
}

std::span<const std::uint32_t> TriedLights::near_to(const Voxel& v) const {
    std::call_once(made_once_->once, [&] { made_once_->blocks = blocks(); });
    const Blocks& all = made_once_->blocks;
    const auto block =
        static_cast<std::size_t>((v.z / block_side * all.count.y + v.y / block_side) * all.count.x + v.x / block_side);
    return std::span(all.lights).subspan(all.starts[block], all.starts[block + 1] - all.starts[block]);
}

TriedLights::Blocks TriedLights::blocks() const {
    Blocks all;
    all.count = (grid_ + (block_side - 1)) / block_side;
    all.starts.resize(static_cast<std::size_t>(all.count.x * all.count.y * all.count.z) + 1);
    const auto for_each_block = [&](const VoxelBox& box, const auto& visit) {
        const auto low = [](int i) { return std::max(i, 0) / block_side; };
        const auto high = [](int i, int n) { return i < 0 ? -1 : std::min(i / block_side, n - 1); };
        for (int z = low(box.low.z); z <= high(box.high.z, all.count.z); ++z)
            for (int y = low(box.low.y); y <= high(box.high.y, all.count.y); ++y)
                for (int x = low(box.low.x); x <= high(box.high.x, all.count.x); ++x)
                    visit(static_cast<std::size_t>((z * all.count.y + y) * all.count.x + x));
    };
    for (const TriedVoxels& one : *voxels_)
        for_each_block(one.box, [&](std::size_t block) { ++all.starts[block + 1]; });
    std::partial_sum(all.starts.begin(), all.starts.end(), all.starts.begin());
    all.lights.resize(all.starts.back());
    std::vector<std::size_t> next = all.starts;
    for (std::uint32_t k = 0; k < voxels_->size(); ++k)
        for_each_block((*voxels_)[k].box, [&](std::size_t block) { all.lights[next[block]++] = k; });
    return all;
}

} // namespace lockstep::lights
