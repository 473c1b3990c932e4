#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "reference/model/collision/octree.hpp"

namespace lockstep {

/// A node as shaders/collision/octree_pass.comp reads it (std430, 48 bytes).
struct OctreeNode {
    glm::vec3 min;             ///< its box
    std::uint32_t entries = 0; ///< in it and its children
    glm::vec3 max;
    std::uint32_t children = 0; ///< 8, of a leaf 0
    std::uint32_t leaf = 0;     ///< 1 or 0
    std::uint32_t depth = 0;    ///< of the root 0
    std::uint32_t first = 0;    ///< a leaf's entries are indices()[first, first + entries)
    std::uint32_t unused = 0;
};
static_assert(sizeof(OctreeNode) == 48);

/// The comparator's octree on the CPU (reference/model/collision/octree.hpp). Nodes are in breadth-first order: the
/// children of node n are 8 n + 1 to 8 n + 8, x first, then y, then z.
///
/// A GLSL structure cannot end in an array of any length, so the leaves' arrays of indices lie in one, leaf by leaf.
class Octree {
  public:
    static constexpr std::size_t leaf_count = std::size_t{1} << (3 * octree_depth);
    static constexpr std::size_t node_count = (8 * leaf_count - 1) / 7;
    static constexpr std::size_t first_leaf = node_count - leaf_count;

    /// `size`: side of the root, world units. Empty at first.
    explicit Octree(float size);

    /// Fills the leaves anew: particles get the indices from 0, then the obstacles' vertices.
    void refresh(std::span<const glm::vec3> particles, std::span<const glm::vec3> obstacles);

    [[nodiscard]] std::span<const OctreeNode> nodes() const { return nodes_; }
    [[nodiscard]] std::span<const std::uint32_t> indices() const { return indices_; }

    /// Every particle once, those of a leaf side by side: what runs in this order looks at the same entries.
    [[nodiscard]] std::span<const std::uint32_t> order() const { return order_; }

    /// The node texture, 8 x node_texture_rows texels: node 0 at (0, 0), child k of node n at (k, n + 1). A texel holds
    /// x and y of the first child, the number of children, and the node's index.
    static constexpr int node_texture_rows = static_cast<int>(first_leaf) + 1;
    static std::vector<std::array<std::uint32_t, 4>> node_texture();

  private:
    [[nodiscard]] std::int32_t leaf_of(glm::vec3 position) const;

    std::vector<OctreeNode> nodes_;
    std::vector<std::uint32_t> indices_, order_;
    std::vector<std::int32_t> leaf_; ///< scratch: of each entry, -1 outside the root
};

} // namespace lockstep
