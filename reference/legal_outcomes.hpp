#pragma once
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "reference/collision_pass.hpp"
#include "reference/legal_arithmetic.hpp"
#include "reference/model/image.hpp"
#include "reference/model/particles.hpp"
#include "reference/model/profile.hpp"
#include "reference/model/scene.hpp"
#include "reference/undefined.hpp"

namespace lockstep {

/// A decision of the pass that legal rounding can take either way, and how far its operands are from the border.
enum class TieKind {
    search,          ///< collide time a subnormal below 0; margin in seconds
    base_texel,      ///< image position at a texel's edge; margin in 1/256 texel
    collision_range, ///< a distance at the collision range; margin in world units
    nearest,         ///< two distances as good as equal; margin: their difference, world units
    point_edge,      ///< window position at a pixel's edge; margin in 1/256 pixel
    depth,           ///< two depths as good as equal; margin: their difference, window depth
};
std::string_view tie_name(TieKind kind);
std::string_view tie_unit(TieKind kind);

struct Tie {
    TieKind kind = TieKind::base_texel;
    double margin = 0.0;
};

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
