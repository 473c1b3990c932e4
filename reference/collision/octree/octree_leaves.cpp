#include "reference/collision/octree/octree_leaves.hpp"

#include <cmath>
#include <limits>

#include "reference/collision/octree_pass.hpp"

namespace lockstep {
namespace {

constexpr std::size_t leaf_count = std::size_t{1} << (3 * octree_depth);

} // namespace

OctreeLeaves fill_leaves(std::span<const glm::vec3> particles, const Mesh& obstacles, const FrameParams& params) {
    const bool with_obstacles = params.switches.obstacles_in_cdt != ObstaclesInCdt::off;
    const std::size_t count = particles.size() + (with_obstacles ? obstacles.positions.size() : 0);
    const auto position = [&](std::size_t i) {
        return i < particles.size() ? particles[i] : obstacles.positions[i - particles.size()];
    };
    std::vector<std::vector<std::int32_t>> entries(leaf_count);
    for (std::size_t i = 0; i < count; ++i)
        if (const std::int32_t leaf = octree_leaf(position(i), params.constants.octree_size); leaf != no_leaf)
            entries[static_cast<std::size_t>(leaf)].push_back(static_cast<std::int32_t>(i));
    OctreeLeaves leaves;
    leaves.particles = static_cast<std::int32_t>(particles.size());
    for (const std::vector<std::int32_t>& leaf : entries) {
        leaves.first.push_back(leaves.entry.size());
        leaves.entry.insert(leaves.entry.end(), leaf.begin(), leaf.end());
    }
    leaves.first.push_back(leaves.entry.size());
    for (const std::int32_t i : leaves.entry)
        leaves.position.push_back(position(static_cast<std::size_t>(i)));
    return leaves;
}

LeafEntries leaf_of(glm::vec3 position, const OctreeLeaves& leaves, const FrameParams& params) {
    const std::int32_t found = octree_leaf(position, params.constants.octree_size);
    if (found == no_leaf)
        return {};
    const auto leaf = static_cast<std::size_t>(found);
    const std::size_t first = leaves.first[leaf], count = leaves.first[leaf + 1] - first;
    return {{leaves.entry.data() + first, count}, {leaves.position.data() + first, count}, leaves.particles};
}

std::int32_t octree_leaf(glm::vec3 position, float size) {
    glm::vec3 low(-0.5F * size);
    glm::vec3 high(0.5F * size);
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(position[axis]) <= std::numeric_limits<float>::min())
            position[axis] = 0.0F;
        if (!(position[axis] >= low[axis] && position[axis] < high[axis]))
            return no_leaf;
    }
    std::int32_t leaf = 0;
    for (int depth = 0; depth < octree_depth; ++depth) {
        leaf *= 8;
        for (int axis = 0; axis < 3; ++axis) {
            const float middle = (low[axis] + high[axis]) * 0.5F;
            const bool upper = position[axis] >= middle;
            leaf += upper ? 1 << axis : 0;
            (upper ? low : high)[axis] = middle;
        }
    }
    return leaf;
}

} // namespace lockstep
