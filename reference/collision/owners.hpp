#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"
#include "reference/model/mesh.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// Whose positions a CDT holds: which the CDT itself does not say.
constexpr std::int32_t empty_owner = -1;
constexpr std::int32_t obstacle_owner = -2;

struct Owners {
    Image<std::int32_t> owner;       ///< of each texel: a particle's index, empty_owner or obstacle_owner
    std::vector<std::int32_t> drawn; ///< of each particle: the texel it was drawn to, whoever won it; or no_texel
};

/// The owners of the CDT that rasterise_particles draws from the same arguments after obstacle_pass.
Owners draw_owners(const Particles& before, const Particles& after, const Mesh& obstacles, const FrameParams& params,
                   const Profile& profile);

/// The texels particles at these positions are drawn to, as indices into an image of params.width x params.height;
/// no_texel where not drawn.
std::vector<std::int32_t> drawn_texels(std::span<const glm::vec3> positions, const FrameParams& params,
                                       const Profile& profile);

} // namespace lockstep
