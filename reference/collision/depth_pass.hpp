#pragma once
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// The particle pass of the depth comparator: every particle is held against the obstacles' depth that the obstacle
/// pass left in `depth` the frame before, then answers or integrates as in the collision pass. Twin of
/// shaders/collision/depth_pass.comp. Pure, the same bits for any thread count; `after` is resized and must not be
/// `before`.
void depth_pass(const Particles& before, const CollisionImage& depth, const FrameParams& params, const Profile& profile,
                Particles& after);

} // namespace lockstep
