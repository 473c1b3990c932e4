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

std::size_t cell_index(const Grid& grid, const glm::vec3& p, CellBy by) {
    const float more = by == CellBy::nearest_corner ? 0.5F * grid.voxel : 0.0F;
    const Voxel cell = clamped_cell(grid, cell_of(grid, p + more));
    if (by != CellBy::y_first)
        return cell.index(grid);
    return static_cast<std::size_t>((cell.y * grid.size.z + cell.z) * grid.size.x + cell.x);
}

/// By light.
std::vector<std::size_t> cells_of(const Host& host, const SystemView& state, const std::vector<std::uint32_t>& lights,
                                  CellBy by) {
    std::vector<std::size_t> cell(state[light_buffer].count());
    for (const std::uint32_t i : lights)
        cell[i] = cell_index(host.grid(), state.vec3(field::light_position, i), by);
    return cell;
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

/// A loop over cells that ends before the last one: one fewer to the low side, and none of the grid's last.
void end_early(int& low, int& high, int cell, int size) {
    ++low;
    if (cell == size - 1)
        high = low - 1;
}

void take_away(WronglyTried how, const glm::ivec3& size, TriedVoxels& of) {
    VoxelBox& box = of.box;
    switch (how) {
    case WronglyTried::two_short:
        box.high = {box.high.x - 2, box.high.y - 2, box.high.z - 2};
        break;
    case WronglyTried::two_late:
        box.low = {box.low.x + 2, box.low.y + 2, box.low.z + 2};
        break;
    case WronglyTried::own_column:
        box.low.x = box.high.x = of.cell.x;
        break;
    case WronglyTried::next_rows:
        box.high.y = of.cell.y + 1;
        break;
    case WronglyTried::next_layers:
        box.high.z = of.cell.z + 1;
        break;
    case WronglyTried::next_cells:
        box = {{of.cell.x - 1, of.cell.y - 1, of.cell.z - 1}, {of.cell.x + 1, of.cell.y + 1, of.cell.z + 1}};
        break;
    case WronglyTried::lower_half:
        box.high = {of.cell.x + 1, of.cell.y + 1, of.cell.z + 1};
        break;
    case WronglyTried::upper_half:
        box.low = {of.cell.x - 1, of.cell.y - 1, of.cell.z - 1};
        break;
    case WronglyTried::own_layer:
        box.low.z = box.high.z = of.cell.z;
        break;
    case WronglyTried::last_layer:
        box.high.z = std::min(box.high.z, size.z - 1) - 1;
        break;
    case WronglyTried::last_layer_of_cells:
        end_early(box.low.z, box.high.z, of.cell.z, size.z);
        break;
    case WronglyTried::last_cells_of_rows:
        end_early(box.low.x, box.high.x, of.cell.x, size.x);
        break;
    case WronglyTried::from_world_origin:
        break;
    }
}

} // namespace

std::vector<std::uint32_t> by_cell(const Host& host, const SystemView& state, CellBy by) {
    std::vector<std::uint32_t> all = finite_lights(state);
    const std::vector<std::size_t> cell = cells_of(host, state, all, by);
    std::stable_sort(all.begin(), all.end(), [&](std::uint32_t a, std::uint32_t b) { return cell[a] < cell[b]; });
    return all;
}

CellLists cell_lists(const Host& host, const SystemView& state, CellBy by) {
    CellLists lists{by_cell(host, state, by), std::vector<std::uint32_t>(host.grid().count()), {}};
    const std::vector<std::size_t> cell = cells_of(host, state, lists.order, by);
    for (const std::uint32_t i : lists.order)
        ++lists.counts[cell[i]];
    std::uint32_t sum = 0;
    for (const std::uint32_t count : lists.counts) {
        lists.starts.push_back(sum);
        sum += count;
    }
    return lists;
}

CellBy sorted_by(std::span<const Mistake> made) {
    for (const Mistake& mistake : made)
        if (mistake.change == Change::handed_over)
            return static_cast<CellBy>(mistake.part);
    return CellBy::place;
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
    : grid_(host.grid().size), origin_(host.grid().origin / host.grid().voxel),
      voxels_(std::make_shared<const std::vector<TriedVoxels>>(voxels_of(host, state, order))),
      made_once_(std::make_shared<MadeOnce>()) {}

TriedLights TriedLights::mistaken(std::span<const Mistake> made) const {
    TriedLights fewer = *this;
    for (const Mistake& mistake : made) {
        if (mistake.change != Change::handed_over)
            continue;
        const auto how = static_cast<WronglyTried>(mistake.part);
        if (how == WronglyTried::from_world_origin)
            return moved();
        static_cast<void>(made_blocks());
        std::vector<TriedVoxels> all = *fewer.voxels_;
        for (TriedVoxels& one : all)
            take_away(how, grid_, one);
        fewer.voxels_ = std::make_shared<const std::vector<TriedVoxels>>(std::move(all));
    }
    return fewer;
}

const TriedLights::Blocks& TriedLights::made_blocks() const {
    std::call_once(made_once_->once, [&] { made_once_->blocks = blocks(); });
    return made_once_->blocks;
}

const TriedLights& TriedLights::moved() const {
    std::call_once(made_once_->moved_once, [&] {
        std::vector<TriedVoxels> all = *voxels_;
        for (TriedVoxels& one : all)
            for (Voxel* const end : {&one.box.low, &one.box.high})
                *end = {end->x + origin_.x, end->y + origin_.y, end->z + origin_.z};
        auto made = std::make_unique<TriedLights>(*this);
        made->voxels_ = std::make_shared<const std::vector<TriedVoxels>>(std::move(all));
        made->made_once_ = std::make_shared<MadeOnce>();
        made_once_->moved = std::move(made);
    });
    return *made_once_->moved;
}

std::span<const std::uint32_t> TriedLights::near_to(const Voxel& v) const {
    const Blocks& all = made_blocks();
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
