#pragma once
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "reference/collision/collision_pass.hpp"
#include "reference/legal_arithmetic.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"
#include "reference/model/profile.hpp"
#include "reference/tie.hpp"
#include "reference/undefined.hpp"

namespace lockstep {

/// One way a particle's step may legally go, and what its fields may then be. Fields are sets of floats; a state is
/// legal when all of its fields lie in the same outcome.
struct LegalOutcome {
    bool hit = false;
    BaseTexelIndex base;      ///< hit: the texel searched round
    BaseTexelIndex neighbour; ///< hit: the texel whose position was nearest
    Interval3 position, direction;
    Interval speed, collide_time;
    std::vector<Tie> ties; ///< the decisions on the way that could have gone otherwise
    Undefined undefined = Undefined::none;

    [[nodiscard]] bool contains(const ParticleState& state) const;
};

/// Every outcome of update_particles that GLSL's precision rules, and what is known beyond them, allow for one
/// particle: base texels at a texel's edge, distances at the range, nearest among equals, then response or integration.
/// Never empty; one outcome where nothing is close.
///
/// `observed`: the state to be judged. The position follows from direction and speed by sums and products alone, so
/// where the shader makes those `precise`, the outcomes' positions are the ones that follow from the observed
/// direction and speed (if these are legal themselves). Null: from all legal ones.
std::vector<LegalOutcome> legal_outcomes(const ParticleState& before, const CollisionImage& cdt,
                                         const FrameParams& params, const Profile& profile,
                                         const KnownOperations& known, const ParticleState* observed);

} // namespace lockstep
