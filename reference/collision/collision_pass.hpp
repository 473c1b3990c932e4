#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// The collision pass (thesis, Fig. 3-3; spec, "The two steps of a frame"): every particle looks for the nearest stored
/// position round its texel of `cdt`, answers or integrates, and is drawn as a size-1 point into the next CDT.
/// Twin of shaders/collision/collision_pass.*. Pure: the answer depends on the arguments alone, not on the thread
/// count.

/// Vertex stage: the state after the step. `after` is resized; it must not be `before`.
void update_particles(const Particles& before, const CollisionImage& cdt, const FrameParams& params,
                      const Profile& profile, Particles& after);

/// Rasteriser and fragment stage: draws `after` into `cdt` (params.width x params.height, holding what was drawn
/// before, as `depth` does), in index order, depth test LESS. `before` is where switch raster_position takes the
/// point from when it is before_step.
void rasterise_particles(const Particles& before, const Particles& after, const FrameParams& params,
                         const Profile& profile, CollisionImage& cdt, DepthImage& depth);

/// The texel a particle at `position` is drawn to, with its window depth; x is -1 where it is not drawn.
struct PointFragment {
    int x = -1;
    int y = -1;
    float depth = 1.0F;
};
PointFragment point_fragment(glm::vec3 position, const FrameParams& params, const Profile& profile);

/// The same of a clip position, where the pass itself finds texel and depth (places_points).
PointFragment placed_fragment(glm::vec4 clip, const FrameParams& params, const Profile& profile);

/// The texel a particle at `position` searches round, x -1 where it lies outside the image (listing, lines 2 to 4).
struct BaseTexelIndex {
    int x = -1;
    int y = -1;
};
BaseTexelIndex base_texel(glm::vec3 position, const FrameParams& params, const Profile& profile);

/// For each position the texel, as an index into cdt.texels, whose content update_particles would collide with, were
/// the collide time negative; no_texel where it would find nothing (listing, lines 5 to 19).
constexpr std::int32_t no_texel = -1;
std::vector<std::int32_t> collision_texels(std::span<const glm::vec3> positions, const CollisionImage& cdt,
                                           const FrameParams& params, const Profile& profile);

} // namespace lockstep
