#pragma once
#include <vector>

#include "reference/legal_outcomes.hpp"

namespace lockstep {

std::vector<LegalOutcome> collision_worlds(const ParticleState& before, const CollisionImage& cdt,
                                           const FrameParams& params, const Profile& profile,
                                           const KnownOperations& known, const ParticleState* observed);

} // namespace lockstep
