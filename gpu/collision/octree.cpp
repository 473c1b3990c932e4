#include "gpu/collision/octree.hpp"

#include <cmath>
#include <limits>

namespace lockstep {
namespace {

float settled(float x) { return std::fabs(x) <= std::numeric_limits<float>::min() ? 0.0F : x; }

bool holds(const OctreeNode& node, glm::vec3 p) {
    return p.x >= node.min.x && p.y >= node.min.y && p.z >= node.min.z && p.x < node.max.x && p.y < node.max.y &&
           p.z < node.max.z;
}

} // namespace

Octree::Octree(float size) : nodes_(node_count) {
    nodes_[0].min = glm::vec3(-0.5F * size);
    nodes_[0].max = glm::vec3(0.5F * size);
    for (std::size_t n = 0; n < first_leaf; ++n) {
        OctreeNode& node = nodes_[n];
        node.children = 8;
        const glm::vec3 centre = (node.min + node.max) * 0.5F;
        for (std::size_t k = 0; k < 8; ++k) {
            OctreeNode& child = nodes_[8 * n + 1 + k];
            child.depth = node.depth + 1;
            for (int axis = 0; axis < 3; ++axis) {
                const bool upper = (k >> axis & 1U) != 0;
                child.min[axis] = upper ? centre[axis] : node.min[axis];
                child.max[axis] = upper ? node.max[axis] : centre[axis];
            }
        }
    }
    for (std::size_t n = first_leaf; n < node_count; ++n)
        nodes_[n].leaf = 1;
}

std::int32_t Octree::leaf_of(glm::vec3 position) const {
    const glm::vec3 p(settled(position.x), settled(position.y), settled(position.z));
    if (!holds(nodes_[0], p))
        return -1;
    std::size_t node = 0;
    while (node < first_leaf) {
        const glm::vec3 centre = nodes_[8 * node + 1].max;
        node = 8 * node + 1 + (p.x >= centre.x ? 1U : 0U) + (p.y >= centre.y ? 2U : 0U) + (p.z >= centre.z ? 4U : 0U);
    }
    return static_cast<std::int32_t>(node);
}

void Octree::refresh(std::span<const glm::vec3> particles, std::span<const glm::vec3> obstacles) {
    const auto count = static_cast<std::ptrdiff_t>(particles.size() + obstacles.size());
    leaf_.resize(static_cast<std::size_t>(count));
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        const auto p = static_cast<std::size_t>(i);
        leaf_[p] = leaf_of(p < particles.size() ? particles[p] : obstacles[p - particles.size()]);
    }

    for (OctreeNode& node : nodes_)
        node.entries = 0;
    std::uint32_t held = 0;
    for (const std::int32_t leaf : leaf_)
        if (leaf >= 0) {
            ++nodes_[static_cast<std::size_t>(leaf)].entries;
            ++held;
        }
    std::uint32_t first = 0;
    for (std::size_t n = first_leaf; n < node_count; ++n) {
        nodes_[n].first = first;
        first += nodes_[n].entries;
        nodes_[n].entries = 0; // counted again below, as a cursor
    }
    indices_.resize(held);
    for (std::size_t i = 0; i < leaf_.size(); ++i)
        if (leaf_[i] >= 0) {
            OctreeNode& node = nodes_[static_cast<std::size_t>(leaf_[i])];
            indices_[node.first + node.entries++] = static_cast<std::uint32_t>(i);
        }
    order_.clear();
    for (const std::uint32_t entry : indices_)
        if (entry < particles.size())
            order_.push_back(entry);
    for (std::size_t i = 0; i < particles.size(); ++i)
        if (leaf_[i] < 0)
            order_.push_back(static_cast<std::uint32_t>(i));
    for (std::size_t n = node_count; n-- > 1;)
        nodes_[(n - 1) / 8].entries += nodes_[n].entries;
}

std::vector<std::array<std::uint32_t, 4>> Octree::node_texture() {
    std::vector<std::array<std::uint32_t, 4>> texels(8 * static_cast<std::size_t>(node_texture_rows));
    for (std::uint32_t n = 0; n < node_count; ++n) {
        const std::size_t texel = n == 0 ? 0 : 8 * ((n - 1) / 8 + 1) + (n - 1) % 8;
        texels[texel] =
            n < first_leaf ? std::array<std::uint32_t, 4>{0, n + 1, 8, n} : std::array<std::uint32_t, 4>{0, 0, 0, n};
    }
    return texels;
}

} // namespace lockstep
