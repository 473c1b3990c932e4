#pragma once
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"
#include "reference/model/mesh.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// Draws the obstacles into the CDT, before the particles (spec, switch obstacles_in_cdt): `triangles` store the world
/// position at each covered texel's centre, `vertices` one point a mesh vertex, drawn like a particle; `off` nothing.
/// Depth test LESS in drawing order. Twin of shaders/collision/obstacle_pass.* and gpu/collision/obstacle_pass.*.
/// `cdt` and `depth` are params.width x params.height and hold what was drawn before.
void obstacle_pass(const Mesh& obstacles, const FrameParams& params, const Profile& profile, CollisionImage& cdt,
                   DepthImage& depth);

} // namespace lockstep
