#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include <glm/vec3.hpp>

namespace lockstep {

/// Points sorted into the cells of a uniform lattice, for searches within a range.
///
/// A cell is a little wider than the range, so whatever lies within range of a point lies in the point's cell or in one
/// of the 26 around it. The grid is a torus: lattice cells that are a multiple of `cells` apart share a grid cell. That
/// bounds the memory at about four cells a point wherever the points are; sharing costs a search time, never an answer.
struct CellGrid {
    struct Point {
        glm::vec3 position;
        std::int32_t index; ///< in the span the grid was built from
    };
    /// Entries of `points` beyond the last that may be read, so that points can be copied this many at a time.
    static constexpr std::size_t slack = 4;

    std::array<std::size_t, 3> cells{3, 3, 3}; ///< along x, y, z; at least 3, so that a cell and its neighbours are 27
    std::size_t point_count = 0;
    std::unique_ptr<Point[]> points;        ///< by cell, x fastest; by index within a cell
    std::unique_ptr<std::uint32_t[]> first; ///< of each cell: its first point; one more entry ends the last cell
};

/// Sorts the positions whose three coordinates are finite and leaves the others out. Any coordinates will do; at most
/// 2^31 - 1 positions. `range`: finite, > 0. The result does not depend on the number of threads.
CellGrid sort_into_cells(std::span<const glm::vec3> positions, float range);

} // namespace lockstep
