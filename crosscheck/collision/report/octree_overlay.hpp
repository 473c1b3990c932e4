#pragma once
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "reference/model/overlay_line.hpp"

namespace lockstep {

/// The edges of every octree node (reference/model/collision/octree.hpp) that holds a position, the root first, leaves
/// last, in colours by depth. `size`: side of the root. Nothing where no position lies in the root.
std::vector<OverlayLine> octree_overlay(std::span<const glm::vec3> positions, float size);

} // namespace lockstep
