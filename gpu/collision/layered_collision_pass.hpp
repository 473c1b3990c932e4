#pragma once
#include <array>
#include <cstddef>
#include <filesystem>

#include "gpu/collision/layered_texture.hpp"
#include "gpu/collision/obstacle_pass.hpp"
#include "gpu/collision/particle_buffer.hpp"
#include "gpu/mesh_buffer.hpp"
#include "gpu/object.hpp"
#include "gpu/program.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// The collision pass with the remedies on GL. shaders/collision/layered_collision_pass.vert steps the particles by
/// transform feedback; shaders/collision/layered_cdt.* then draws them once for each layer, leaving out what the layers
/// before hold: depth peeling by depth and index. Twin of reference/collision/layered_collision_pass.hpp.
class LayeredCollisionPass {
  public:
    /// For images of width x height. `shaders` is looked into before the shipped folder; may be empty.
    LayeredCollisionPass(const Switches& switches, const std::filesystem::path& shaders, int width, int height);

    /// Steps `from` into `to`, reading `cdt`; draws obstacles and particles into every plane of `target`.
    void run(const FrameParams& params, const MeshBuffer& obstacles, ObstaclePass& obstacle_pass,
             const ParticleBuffer& from, ParticleBuffer& to, const LayeredTexture& cdt, const LayeredTexture& target);

    /// Waits for the last run. Throws Error unless all particles were captured.
    void verify_written(std::size_t expected) const;

  private:
    void step(const FrameParams& params, bool obstacles, const ParticleBuffer& from, ParticleBuffer& to,
              const LayeredTexture& cdt);
    void clear(const LayeredTexture& target);
    void draw_obstacles(int camera, const FrameParams& params, const MeshBuffer& obstacles, ObstaclePass& obstacle_pass,
                        const LayeredTexture& target);
    void draw_layer(int camera, int layer, const ParticleBuffer& particles, const LayeredTexture& target);

    int width_, height_;
    CdtPlanes planes_;
    Program step_, draw_;
    GlFramebuffer all_planes_, obstacle_plane_, layer_;
    GlTexture depth_;
    std::array<GlTexture, 2> keys_; ///< depth and index of what a texel holds, in the layer drawn and in the one before
    GlQuery written_;
};

} // namespace lockstep
