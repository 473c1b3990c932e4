#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "reference/model/collision/octree.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/mesh.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// The particle pass of the octree comparator (thesis, chapter 5): every particle looks for the nearest entry of its
/// leaf (reference/model/collision/octree.hpp), then answers or integrates as in the collision pass. Twin of
/// shaders/collision/octree_pass.comp. Pure, the same bits for any thread count; `after` is resized and must not be
/// `before`.
void octree_pass(const Particles& before, const Mesh& obstacles, const FrameParams& params, const Profile& profile,
                 Particles& after);

inline constexpr std::int32_t no_leaf = -1;

/// The leaf of a root of side `size` that `position` lies in; leaves are numbered depth first, x before y before z.
std::int32_t octree_leaf(glm::vec3 position, float size);

/// Where the search from each particle ends, whatever its collide time: an index into the particles followed by the
/// obstacles' vertices, -1 where it finds nothing.
std::vector<std::int32_t> octree_partners(std::span<const glm::vec3> positions, const Mesh& obstacles,
                                          const FrameParams& params, const Profile& profile);

} // namespace lockstep
