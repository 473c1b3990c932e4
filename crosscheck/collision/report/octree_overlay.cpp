#include "crosscheck/collision/report/octree_overlay.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <set>

#include "reference/collision/octree_pass.hpp"
#include "reference/model/collision/octree.hpp"

namespace lockstep {
namespace {

constexpr std::array<Rgba8, octree_depth + 1> colours{
    {{240, 240, 240, 255}, {150, 150, 160, 255}, {150, 150, 160, 255}, {90, 200, 110, 255}}};

struct Cube {
    glm::vec3 low;
    float size;
};

/// The node that is reached by `depth` choices of a child, the last one in the lowest three bits.
Cube cube_of(std::int32_t path, int depth, float size) {
    Cube cube{glm::vec3(-0.5F * size), size};
    for (int level = depth - 1; level >= 0; --level) {
        cube.size *= 0.5F;
        for (int axis = 0; axis < 3; ++axis)
            cube.low[axis] += ((path >> (3 * level + axis)) & 1) != 0 ? cube.size : 0.0F;
    }
    return cube;
}

void add_edges(std::vector<OverlayLine>& lines, const Cube& cube, Rgba8 colour) {
    const auto corner = [&](int k) {
        return cube.low + cube.size * glm::vec3((k & 1) != 0 ? 1 : 0, (k & 2) != 0 ? 1 : 0, (k & 4) != 0 ? 1 : 0);
    };
    for (int k = 0; k < 8; ++k)
        for (const int axis : {1, 2, 4})
            if ((k & axis) == 0)
                lines.push_back({corner(k), corner(k | axis), colour});
}

} // namespace

std::vector<OverlayLine> octree_overlay(std::span<const glm::vec3> positions, float size) {
    std::array<std::set<std::int32_t>, octree_depth + 1> occupied;
    for (const glm::vec3 position : positions)
        if (const std::int32_t leaf = octree_leaf(position, size); leaf != no_leaf)
            for (int depth = 0; depth <= octree_depth; ++depth)
                occupied[static_cast<std::size_t>(depth)].insert(leaf >> (3 * (octree_depth - depth)));
    std::vector<OverlayLine> lines;
    for (std::size_t depth = 0; depth < occupied.size(); ++depth)
        for (const std::int32_t path : occupied[depth])
            add_edges(lines, cube_of(path, static_cast<int>(depth), size), colours[depth]);
    return lines;
}

} // namespace lockstep
