#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "reference/model/collision/scene.hpp"
#include "reference/model/mesh.hpp"

namespace lockstep {

/// What a leaf of the octree holds: particles, then obstacles' corners, by number and position.
struct LeafEntries {
    std::span<const std::int32_t> number;
    std::span<const glm::vec3> position;
    std::int32_t particles = 0; ///< numbers from here on are obstacles' corners
};

/// What the leaves hold, leaf by leaf.
struct OctreeLeaves {
    std::vector<std::size_t> first; ///< leaf l has the entries [first[l], first[l + 1])
    std::vector<std::int32_t> entry;
    std::vector<glm::vec3> position; ///< of each entry
    std::int32_t particles = 0;
};

OctreeLeaves fill_leaves(std::span<const glm::vec3> particles, const Mesh& obstacles, const FrameParams& params);

/// The leaf that a position lies in; empty outside the root.
LeafEntries leaf_of(glm::vec3 position, const OctreeLeaves& leaves, const FrameParams& params);

} // namespace lockstep
