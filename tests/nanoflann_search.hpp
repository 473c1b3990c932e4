#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/vec3.hpp>
#include <nanoflann.hpp>

#include "reference/collision/neighbours.hpp"

namespace lockstep::test {

/// Collects the neighbours of one particle from nanoflann.
template <class Real> struct NeighbourhoodResult {
    using DistanceType = Real;
    using IndexType = std::uint32_t;
    Real limit;
    std::int32_t self;
    Neighbourhood found{};

    [[nodiscard]] bool full() const { return true; }
    [[nodiscard]] Real worstDist() const { return limit; }
    bool addPoint(Real squared, std::uint32_t index) {
        const auto other = static_cast<std::int32_t>(index);
        if (squared >= limit || other == self)
            return true;
        ++found.count;
        const double exact = squared;
        if (exact < found.squared_distance || (exact == found.squared_distance && other < found.nearest)) {
            found.squared_distance = exact;
            found.nearest = other;
        }
        return true;
    }
    void sort() {}
};

template <class Real> struct PointCloud {
    std::span<const glm::vec3> positions;
    [[nodiscard]] std::size_t kdtree_get_point_count() const { return positions.size(); }
    [[nodiscard]] Real kdtree_get_pt(std::size_t i, std::size_t axis) const { return (&positions[i].x)[axis]; }
    template <class Box> bool kdtree_get_bbox(Box&) const { return false; }
};

/// find_neighbourhoods by nanoflann's k-d tree: the oracle where brute force takes too long, and the yardstick of the
/// benchmark. With Real = double its sum of squares is squared_distance bit for bit; with float it is as nanoflann is
/// commonly used, and some neighbours at the range differ. Finite positions only.
template <class Real> Neighbourhoods nanoflann_neighbourhoods(std::span<const glm::vec3> positions, float range) {
    using Distance = nanoflann::L2_Simple_Adaptor<Real, PointCloud<Real>>;
    const PointCloud<Real> cloud{positions};
    const nanoflann::KDTreeSingleIndexAdaptor<Distance, PointCloud<Real>, 3, std::uint32_t> tree(3, cloud);
    Neighbourhoods result;
    result.particle.resize(positions.size());
#pragma omp parallel for schedule(dynamic, 1024)
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::vec<3, Real> query(positions[i]);
        NeighbourhoodResult<Real> neighbourhood{Real{range} * Real{range}, static_cast<std::int32_t>(i)};
        tree.findNeighbors(neighbourhood, &query.x, {});
        result.particle[i] = neighbourhood.found;
    }
    return result;
}

} // namespace lockstep::test
