#pragma once
#include <cstdint>
#include <optional>

#include "reference/collision/billboard.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"
#include "reference/model/mesh.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// Whose colour a pixel has.
struct PixelOwner {
    enum class Kind : std::uint8_t { background, obstacle, particle };
    Kind kind = Kind::background;
    std::uint32_t index = 0; ///< triangle of the obstacles, or particle

    bool operator==(const PixelOwner&) const = default;
};

struct RenderedFrame {
    ColorImage color;
    Image<PixelOwner> owner;
};

/// The render pass: background, obstacles flat shaded, and every particle as a camera-facing square with a sphere drawn
/// on it, coloured by its state. Depth test LESS. params.render_width x params.render_height.
/// Twin of shaders/collision/render_*.* and gpu/collision/render_pass.*.
ColorImage render_pass(const Particles& particles, const Mesh& obstacles, const FrameParams& params,
                       const Profile& profile);

/// The same, with whose each pixel is.
RenderedFrame render_with_owners(const Particles& particles, const Mesh& obstacles, const FrameParams& params,
                                 const Profile& profile);

/// The geometry shader's square for a particle at `position` (world space).
Billboard particle_billboard(glm::vec3 position, const FrameParams& params, const Profile& profile);

/// Where in the window it lies, pixels; nothing where none is emitted.
std::optional<BillboardWindow> particle_window(glm::vec3 position, const FrameParams& params, const Profile& profile);

} // namespace lockstep
