#pragma once
#include "reference/collision/deviation.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"
#include "reference/model/mesh.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// What obstacle_pass makes of triangles with the deviations made, in place of what `cdt` and `depth` hold. Where none
/// changes obstacles, or they are not drawn as triangles, both stay as they are.
void deviating_obstacles(const Mesh& obstacles, const FrameParams& params, const Profile& profile,
                         const Deviations& deviations, CollisionImage& cdt, DepthImage& depth);

} // namespace lockstep
