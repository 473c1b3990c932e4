#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace lockstep {

/// Exact search for neighbours: the truth an image-based collision is measured against.
///
/// The rule: particle b is a neighbour of particle a when b is not a itself (by index: coincident particles are
/// neighbours), both have finite coordinates, and squared_distance(a, b) < double(range) * double(range). The nearest
/// neighbour has the least squared distance, of several the lowest index. Nothing else enters: not the cells a search
/// sorts into, not the number of threads.
///
/// The rule as computed: differences of the float coordinates in double (exact unless their exponents are more than 28
/// apart), then one rounding for each square and sum, in this order. It neither overflows nor underflows, and range *
/// range is exact.
inline double squared_distance(glm::vec3 a, glm::vec3 b) {
    const double dx = double{a.x} - double{b.x};
    const double dy = double{a.y} - double{b.y};
    const double dz = double{a.z} - double{b.z};
    return (dx * dx + dy * dy) + dz * dz;
}

constexpr std::int32_t no_neighbour = -1;

/// What the search says of one particle.
struct Neighbourhood {
    double squared_distance = std::numeric_limits<double>::infinity(); ///< to the nearest; infinity: none
    std::int32_t nearest = no_neighbour;                               ///< index of the nearest neighbour
    std::uint32_t count = 0;                                           ///< neighbours
};

struct Neighbourhoods {
    std::vector<Neighbourhood> particle; ///< as many as positions
    std::size_t ignored = 0; ///< particles with a NaN or an infinity in their position: they have no neighbours
};

/// `range`: world units, finite, >= 0 (0: nothing is a neighbour). At most 2^31 - 1 positions. Throws Error otherwise.
Neighbourhoods find_neighbourhoods(std::span<const glm::vec3> positions, float range);

/// Every pair within range, seen from both ends.
struct NeighbourLists {
    std::vector<std::size_t> start;       ///< particle i's neighbours are [start[i], start[i + 1]) of `neighbours`
    std::vector<std::int32_t> neighbours; ///< ascending for each particle

    [[nodiscard]] std::span<const std::int32_t> of(std::size_t particle) const {
        return std::span(neighbours).subspan(start[particle], start[particle + 1] - start[particle]);
    }
};

/// Same rule, same conditions.
NeighbourLists list_neighbours(std::span<const glm::vec3> positions, float range);

} // namespace lockstep
