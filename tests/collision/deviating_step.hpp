#pragma once
#include <cstddef>
#include <span>

#include "reference/collision/deviation.hpp"
#include "reference/collision/frame_inputs.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/profile.hpp"
#include "reference/readings/mistake.hpp"

namespace lockstep::test {

/// Particle `i` after the listing's step with mistakes made; without any, the very bits of collision_pass.hpp.
ParticleState mistaken_step(const FrameInputs& inputs, std::size_t i, const Profile& profile,
                            std::span<const Mistake> mistakes);
ParticleState deviating_step(const FrameInputs& inputs, std::size_t i, const Profile& profile,
                             const Deviations& deviations);

} // namespace lockstep::test
