#pragma once
#include <filesystem>

#include "gpu/collision/collision_texture.hpp"
#include "gpu/collision/particle_buffer.hpp"
#include "gpu/object.hpp"
#include "gpu/program.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// The collision pass on GL: shaders/collision/collision_pass.*, one point a particle, transform feedback into the
/// other buffer, fragments into the CDT of the next frame. Twin of reference/collision/collision_pass.hpp.
class CollisionPass {
  public:
    /// `shaders` is looked into first (spec, "Names a foreign shader must use"); may be empty. `depth`: the host's.
    CollisionPass(const Switches& switches, const std::filesystem::path& shaders, const ClipDepth& depth);

    /// Steps `from` into `to`, reading `cdt`, drawing into `target` on top of what it holds.
    void run(const FrameParams& params, const ParticleBuffer& from, ParticleBuffer& to, const CollisionTexture& cdt,
             CollisionTexture& target);

    /// Waits for the last run. Throws Error unless the shaders emitted one point a particle and all were captured.
    void verify_written(std::size_t expected) const;

  private:
    Program program_;
    GlQuery emitted_; ///< also what finds no room in the buffer
    GlQuery written_;
};

/// Sets every uniform of the pass (spec, "Names a foreign shader must use"), u_CDTexture to texture unit 0.
void set_collision_uniforms(const Program& program, const FrameParams& params);

} // namespace lockstep
