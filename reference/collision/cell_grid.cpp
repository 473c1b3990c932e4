#include "reference/collision/cell_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

#include <glm/common.hpp>
#include <omp.h>

namespace lockstep {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr std::uint32_t left_out = std::numeric_limits<std::uint32_t>::max();

bool is_finite(glm::vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// From a coordinate to its lattice cell, and from there to its cell on the torus.
struct Axis {
    double cells_per_unit = 1.0;
    std::int64_t lowest = 0; ///< lattice cell that is grid cell 0
    std::int64_t cells = 3;  ///< of the grid

    /// Coordinates within range of each other get the same lattice cell or adjacent ones. Up to 2^40 cells from the
    /// origin, because a quotient is off by at most 2^-12 while a cell is wider than the range by a part in 2^10;
    /// truncation makes cell 0 twice as wide, which does no harm. Farther out, because floats are more than a range
    /// apart there: only equal ones are near, and any cell will do that the coordinate alone decides. Its bits spread
    /// well.
    [[nodiscard]] std::int64_t lattice_cell(float coordinate) const {
        const double quotient = double{coordinate} * cells_per_unit;
        return std::abs(quotient) < 0x1p40 ? static_cast<std::int64_t>(quotient)
                                           : std::bit_cast<std::int32_t>(coordinate);
    }

    [[nodiscard]] std::int64_t grid_cell(float coordinate) const {
        const std::int64_t cell = lattice_cell(coordinate) - lowest;
        if (0 <= cell && cell < cells)
            return cell;
        return (cell % cells + cells) % cells;
    }
};

struct Lattice {
    Axis x, y, z;
    [[nodiscard]] std::size_t cells() const { return static_cast<std::size_t>(x.cells * y.cells * z.cells); }
    [[nodiscard]] std::uint32_t cell(glm::vec3 p) const {
        return static_cast<std::uint32_t>((z.grid_cell(p.z) * y.cells + y.grid_cell(p.y)) * x.cells + x.grid_cell(p.x));
    }
};

/// As many cells as the extent needs and one between its ends; where that is too many, the longest axes wrap around.
Lattice fit_lattice(std::span<const glm::vec3> positions, float range) {
    glm::vec3 low(infinity);
    glm::vec3 high(-infinity);
#pragma omp declare reduction(least : glm::vec3 : omp_out = glm::min(omp_out, omp_in)) initializer(omp_priv = omp_orig)
#pragma omp declare reduction(most : glm::vec3 : omp_out = glm::max(omp_out, omp_in)) initializer(omp_priv = omp_orig)
#pragma omp parallel for schedule(static) reduction(least : low) reduction(most : high)
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (is_finite(positions[i])) {
            low = glm::min(low, positions[i]);
            high = glm::max(high, positions[i]);
        }
    }

    const double budget = std::clamp(4.0 * static_cast<double>(positions.size()), 64.0, 0x1p31);
    const auto fit_axis = [&](float from, float to) {
        Axis axis;
        axis.cells_per_unit = 1.0 / (double{range} * (1.0 + 0x1p-10));
        if (from <= to) {
            axis.lowest = axis.lattice_cell(from);
            const double extent = (double{to} - double{from}) * axis.cells_per_unit;
            axis.cells = static_cast<std::int64_t>(std::clamp(extent + 3.0, 3.0, budget));
        }
        return axis;
    };
    Lattice lattice{fit_axis(low.x, high.x), fit_axis(low.y, high.y), fit_axis(low.z, high.z)};
    auto& [x, y, z] = lattice;
    const auto count = [](const Axis& axis) { return static_cast<double>(axis.cells); };
    while (count(x) * count(y) * count(z) > budget) {
        std::int64_t& longest = std::max({std::ref(x.cells), std::ref(y.cells), std::ref(z.cells)}).get();
        longest -= longest / 8 + 1;
    }
    return lattice;
}

/// Points in buckets of 2^bits consecutive cells, in the order of their indices within a bucket.
struct Buckets {
    int bits = 0;
    std::vector<std::uint32_t> first; ///< of each bucket: its first point; one more entry ends the last bucket
    std::unique_ptr<CellGrid::Point[]> points;
    std::unique_ptr<std::uint32_t[]> cell; ///< of each point
};

/// Every thread counts and then moves its own part of the positions; parts follow each other within a bucket.
Buckets sort_into_buckets(std::span<const glm::vec3> positions, const Lattice& lattice) {
    Buckets result;
    result.bits = std::max(0, static_cast<int>(std::bit_width(lattice.cells())) - 9);
    const std::size_t buckets = ((lattice.cells() - 1) >> result.bits) + 1;
    const auto parts = static_cast<std::size_t>(omp_get_max_threads());
    const auto start_of = [&](std::size_t part) { return positions.size() * part / parts; };

    const auto cell = std::make_unique_for_overwrite<std::uint32_t[]>(positions.size());
    std::vector<std::uint32_t> counts(parts * buckets, 0);
#pragma omp parallel for schedule(static)
    for (std::size_t part = 0; part < parts; ++part) {
        for (std::size_t i = start_of(part); i < start_of(part + 1); ++i) {
            cell[i] = is_finite(positions[i]) ? lattice.cell(positions[i]) : left_out;
            if (cell[i] != left_out)
                ++counts[part * buckets + (cell[i] >> result.bits)];
        }
    }

    std::vector<std::uint32_t> next(parts * buckets);
    std::uint32_t total = 0;
    for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
        result.first.push_back(total);
        for (std::size_t part = 0; part < parts; ++part) {
            next[part * buckets + bucket] = total;
            total += counts[part * buckets + bucket];
        }
    }
    result.first.push_back(total);

    result.points = std::make_unique_for_overwrite<CellGrid::Point[]>(total);
    result.cell = std::make_unique_for_overwrite<std::uint32_t[]>(total);
#pragma omp parallel for schedule(static)
    for (std::size_t part = 0; part < parts; ++part) {
        for (std::size_t i = start_of(part); i < start_of(part + 1); ++i) {
            if (cell[i] == left_out)
                continue;
            const std::uint32_t to = next[part * buckets + (cell[i] >> result.bits)]++;
            result.points[to] = {positions[i], static_cast<std::int32_t>(i)};
            result.cell[to] = cell[i];
        }
    }
    return result;
}

} // namespace

CellGrid sort_into_cells(std::span<const glm::vec3> positions, float range) {
    const Lattice lattice = fit_lattice(positions, range);
    const Buckets buckets = sort_into_buckets(positions, lattice);

    CellGrid grid;
    grid.cells = {static_cast<std::size_t>(lattice.x.cells), static_cast<std::size_t>(lattice.y.cells),
                  static_cast<std::size_t>(lattice.z.cells)};
    grid.point_count = buckets.first.back();
    grid.points = std::make_unique_for_overwrite<CellGrid::Point[]>(grid.point_count + CellGrid::slack);
    grid.first = std::make_unique_for_overwrite<std::uint32_t[]>(lattice.cells() + 1);
    grid.first[lattice.cells()] = buckets.first.back();
    // A counting sort of each bucket: small enough for a cache.
#pragma omp parallel
    {
        const std::size_t bucket_cells = std::size_t{1} << buckets.bits;
        std::vector<std::uint32_t> counts(bucket_cells);
        std::vector<std::uint32_t> next(bucket_cells);
#pragma omp for schedule(dynamic)
        for (std::size_t bucket = 0; bucket < buckets.first.size() - 1; ++bucket) {
            const std::uint32_t begin = buckets.first[bucket];
            const std::uint32_t end = buckets.first[bucket + 1];
            const std::size_t first_cell = bucket * bucket_cells;
            const std::size_t cells = std::min(bucket_cells, lattice.cells() - first_cell);
            std::fill(counts.begin(), counts.end(), 0U);
            for (std::uint32_t i = begin; i < end; ++i)
                ++counts[buckets.cell[i] - first_cell];
            std::exclusive_scan(counts.begin(), counts.end(), next.begin(), begin);
            std::copy_n(next.begin(), cells, grid.first.get() + first_cell);
            for (std::uint32_t i = begin; i < end; ++i)
                grid.points[next[buckets.cell[i] - first_cell]++] = buckets.points[i];
        }
    }
    return grid;
}

} // namespace lockstep
