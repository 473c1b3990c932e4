#pragma once
#include <filesystem>

#include "gpu/collision/particle_buffer.hpp"
#include "gpu/mesh_buffer.hpp"
#include "gpu/object.hpp"
#include "gpu/program.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// The render pass on GL into an image of its own: shaders/collision/render_background.*, render_obstacles.* and
/// render_pass.*, which draws every particle as a billboard. Twin of reference/collision/render_pass.hpp.
class RenderPass {
  public:
    /// Images of width x height pixels; `shaders` is looked into before the shipped folder and may be empty.
    /// Throws Error if GL allows no image of this size.
    RenderPass(const Switches& switches, const std::filesystem::path& shaders, int width, int height);

    /// `params` has this image's render size.
    void run(const ParticleBuffer& particles, const MeshBuffer& obstacles, const FrameParams& params);

    void read(ColorImage& image) const;

  private:
    void set_uniforms(const Program& program, const FrameParams& params) const;

    int width_;
    int height_;
    Program background_;
    Program obstacles_;
    Program particles_;
    GlTexture color_;
    GlTexture depth_;
    GlFramebuffer framebuffer_;
};

} // namespace lockstep
