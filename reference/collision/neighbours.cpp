#include "reference/collision/neighbours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

#include <fmt/format.h>

#include "reference/collision/cell_grid.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

CellGrid checked_grid(std::span<const glm::vec3> positions, float range) {
    if (!std::isfinite(range) || range < 0.0F)
        throw Error(fmt::format("neighbour search: range {} is not a finite number >= 0", range));
    if (positions.size() > std::numeric_limits<std::int32_t>::max())
        throw Error(fmt::format("neighbour search: {} positions are more than 2147483647", positions.size()));
    return sort_into_cells(positions, std::max(range, std::numeric_limits<float>::min()));
}

struct Near {
    double squared_distance;
    std::int32_t index;
};

/// The nine rows of cells around row (y, z), which comes first: their first cells.
using Rows = std::array<std::size_t, 9>;

Rows rows_around(const CellGrid& grid, std::size_t y, std::size_t z) {
    const auto [nx, ny, nz] = grid.cells;
    Rows rows{};
    std::size_t row = 0;
    for (const std::size_t row_z : {z, (z + 1) % nz, (z + nz - 1) % nz})
        for (const std::size_t row_y : {y, (y + 1) % ny, (y + ny - 1) % ny})
            rows[row++] = (row_z * ny + row_y) * nx;
    return rows;
}

/// The points of a cell and of the 26 around it, side by side; among them every neighbour of the cell's points.
class Surroundings {
  public:
    void gather(const CellGrid& grid, const Rows& rows, std::size_t x) {
        const std::size_t last = grid.cells[0] - 1;
        const std::size_t from = x == 0 ? 0 : x - 1;
        const std::size_t to = x == last ? last : x + 1;
        size_ = 0;
        for (const std::size_t row : rows)
            append(grid, row + from, row + to + 1);
        if (to - from == 2)
            return;
        const std::size_t across = x == 0 ? last : 0;
        for (const std::size_t row : rows)
            append(grid, row + across, row + across + 1);
    }

    /// The neighbours of `point`. Without branches: whether a candidate is one cannot be predicted.
    std::span<const Near> neighbours(CellGrid::Point point, double limit) {
        std::size_t found = 0;
        for (std::size_t k = 0; k < size_; ++k) {
            const double squared = squared_distance(point.position, points_[k].position);
            hits_[found] = {squared, points_[k].index};
            found += (squared < limit) & (points_[k].index != point.index) ? 1U : 0U;
        }
        return {hits_.data(), found};
    }

  private:
    /// Copies `slack` points at a time: cells hold few, and how many cannot be predicted.
    void append(const CellGrid& grid, std::size_t first_cell, std::size_t end_cell) {
        const std::size_t from = grid.first[first_cell];
        const std::size_t count = grid.first[end_cell] - from;
        if (points_.size() < size_ + count + CellGrid::slack) {
            points_.resize(2 * (size_ + count + CellGrid::slack));
            hits_.resize(points_.size());
        }
        for (std::size_t k = 0; k < count; k += CellGrid::slack)
            std::memcpy(&points_[size_ + k], &grid.points[from + k], sizeof(CellGrid::Point) * CellGrid::slack);
        size_ += count;
    }

    std::vector<CellGrid::Point> points_; ///< `size_` of them, then room
    std::size_t size_ = 0;
    std::vector<Near> hits_;
};

/// Calls visit(index, hits) for each point of the grid, once, from all threads; and upcoming(index) a few visits ahead.
template <class Upcoming, class Visit>
void for_each_point(const CellGrid& grid, float range, const Upcoming& upcoming, const Visit& visit) {
    constexpr std::size_t visits_ahead = 4;
    const double limit = double{range} * double{range};
#pragma omp parallel
    {
        Surroundings surroundings;
#pragma omp for collapse(2) schedule(dynamic, 16)
        for (std::size_t z = 0; z < grid.cells[2]; ++z) {
            for (std::size_t y = 0; y < grid.cells[1]; ++y) {
                const Rows rows = rows_around(grid, y, z);
                for (std::size_t x = 0; x < grid.cells[0]; ++x) {
                    const std::size_t begin = grid.first[rows[0] + x];
                    const std::size_t end = grid.first[rows[0] + x + 1];
                    if (begin == end)
                        continue;
                    surroundings.gather(grid, rows, x);
                    for (std::size_t p = begin; p < end; ++p) {
                        upcoming(grid.points[std::min(p + visits_ahead, grid.point_count - 1)].index);
                        visit(grid.points[p].index, surroundings.neighbours(grid.points[p], limit));
                    }
                }
            }
        }
    }
}

Neighbourhood summary(std::span<const Near> hits) {
    Neighbourhood result;
    result.count = static_cast<std::uint32_t>(hits.size());
    for (const Near& hit : hits) {
        const bool nearer = (hit.squared_distance < result.squared_distance) |
                            ((hit.squared_distance == result.squared_distance) & (hit.index < result.nearest));
        result.squared_distance = nearer ? hit.squared_distance : result.squared_distance;
        result.nearest = nearer ? hit.index : result.nearest;
    }
    return result;
}

} // namespace

Neighbourhoods find_neighbourhoods(std::span<const glm::vec3> positions, float range) {
    const CellGrid grid = checked_grid(positions, range);
    Neighbourhoods result;
    result.particle.resize(positions.size());
    result.ignored = positions.size() - grid.point_count;
    // The visits go by cell, so a result may lie anywhere: fetched ahead, no store has to wait for its cache line.
    const auto fetch = [&](std::int32_t index) { __builtin_prefetch(&result.particle[index], 1); };
    for_each_point(grid, range, fetch,
                   [&](std::int32_t index, std::span<const Near> hits) { result.particle[index] = summary(hits); });
    return result;
}

NeighbourLists list_neighbours(std::span<const glm::vec3> positions, float range) {
    const CellGrid grid = checked_grid(positions, range);
    const auto ignore = [](std::int32_t) {};
    NeighbourLists lists;
    lists.start.resize(positions.size() + 1, 0);
    for_each_point(grid, range, ignore, [&](std::int32_t index, std::span<const Near> hits) {
        lists.start[static_cast<std::size_t>(index) + 1] = hits.size();
    });
    std::partial_sum(lists.start.begin(), lists.start.end(), lists.start.begin());
    lists.neighbours.resize(lists.start.back());
    for_each_point(grid, range, ignore, [&](std::int32_t index, std::span<const Near> hits) {
        const auto list = lists.neighbours.begin() + static_cast<std::ptrdiff_t>(lists.start[index]);
        std::transform(hits.begin(), hits.end(), list, [](const Near& hit) { return hit.index; });
        std::sort(list, list + std::ssize(hits));
    });
    return lists;
}

} // namespace lockstep
