#pragma once
#include "reference/collision/deviation.hpp"
#include "reference/collision/frame_inputs.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// Draws `after` with the deviations made, on top of the obstacles' `cdt` and `depth`; without any, what
/// rasterise_particles draws. `obstacles_cdt` and depth: the CDT with nothing but the obstacles.
/// `cdt`: of any size; a second drawing into the same one allocates no image.
void deviating_draw(const FrameInputs& inputs, const Particles& after, const Profile& profile,
                    const Deviations& deviations, const CollisionImage& obstacles_cdt,
                    const DepthImage& obstacles_depth, CollisionImage& cdt);

} // namespace lockstep
