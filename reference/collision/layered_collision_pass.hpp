#pragma once
#include <cstdint>
#include <vector>

#include "reference/collision/owners.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"
#include "reference/model/mesh.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// The collision pass with the remedies (docs/remedies.md). Twin of shaders/collision/layered_collision_pass.vert and
/// shaders/collision/layered_cdt.*. A CDT is a stack of planes (reference/model/collision/layered_cdt.hpp); switches as
/// check_switches wants them. Pure: the answer depends on the arguments alone, not on the thread count.
///
/// A particle looks at every position stored in its search windows, camera by camera, row by row, in each texel the
/// obstacle and then the layers from the front; its base texel too, but not at its own stored position, nor at one at
/// distance 0.
///
/// response = single: it answers to the nearest, the first of equally near ones, as in the collision pass.
/// response = mutual: each particle within the range that it approaches, and that searches too, changes its velocity by
/// -(1 + speed_factor) / 2 of the component along the line between them of their relative velocity, speed_factor being
/// the coefficient of restitution: the other's share is the same with the opposite sign. It takes part only if it finds
/// itself in the CDT, since else the others cannot see it. The nearest obstacle point in range reflects it.

/// Vertex stage: the state after the step. `after` is resized; it must not be `before`.
void update_particles_layered(const Particles& before, const CollisionImage& cdt, const FrameParams& params,
                              const Profile& profile, Particles& after);

/// Draws obstacles and particles into every plane of `cdt`; what it held is gone.
void draw_layered_cdt(const Particles& particles, const Mesh& obstacles, const FrameParams& params,
                      const Profile& profile, CollisionImage& cdt);

/// Whose positions it holds then: the particle in each texel of the planes with positions, else empty_owner; and the
/// texel of its plane each particle is drawn to, whoever has it, or no_texel, camera by camera.
struct LayeredOwners {
    Image<std::int32_t> owner;
    std::vector<std::int32_t> drawn;
};
LayeredOwners draw_layered_owners(const Particles& particles, const FrameParams& params, const Profile& profile);

} // namespace lockstep
