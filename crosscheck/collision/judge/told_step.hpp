#pragma once
#include <vector>

#include "crosscheck/judge/system.hpp"
#include "gpu/collision/collision_trace.hpp"

namespace lockstep {

/// What a capture of the collision pass told of a particle's step, as its twin's sites ask for it; `state`: what the
/// step left, where the capture does not know.
std::vector<ToldValue> told_by_capture(const ItemPass& pass, const StepCapture& capture, const ParticleState& state);

} // namespace lockstep
