#pragma once
#include "reference/billboard.hpp"
#include "reference/model/image.hpp"
#include "reference/model/mesh.hpp"
#include "reference/model/particles.hpp"
#include "reference/model/profile.hpp"
#include "reference/model/scene.hpp"

namespace lockstep {

/// The render pass: background, obstacles flat shaded, and every particle as a camera-facing square with a sphere drawn
/// on it, coloured by its state. Depth test LESS. params.render_width x params.render_height.
/// Twin of shaders/render_*.* and gpu/render_pass.*.
ColorImage render_pass(const Particles& particles, const Mesh& obstacles, const FrameParams& params,
                       const Profile& profile);

/// The geometry shader's square for a particle at `position` (world space).
Billboard particle_billboard(glm::vec3 position, const FrameParams& params, const Profile& profile);

} // namespace lockstep
