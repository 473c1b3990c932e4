#pragma once
#include <cstddef>
#include <filesystem>
#include <vector>

#include "gpu/bound_storage.hpp"
#include "gpu/collision/collision_texture.hpp"
#include "gpu/collision/particle_buffer.hpp"
#include "gpu/program.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// Sets the uniforms of shaders/collision/depth_pass.comp but for the particles'.
void set_depth_uniforms(const Program& program, const FrameParams& params);

/// The depth comparator on GL: shaders/collision/depth_pass.comp holds each particle against the obstacles' depth,
/// which the obstacle pass drew the frame before. Twin of reference/collision/depth_pass.hpp.
class DepthPass {
  public:
    /// `shaders`: a folder looked into before the shipped one, or empty. Throws Error where the context has no compute
    /// shaders (GL 4.3).
    DepthPass(const Scene& scene, const std::filesystem::path& shaders);

    void run(const FrameParams& params, const ParticleBuffer& from, ParticleBuffer& to, const CollisionTexture& depth);

    /// Throws Error if the last run wrote behind the particles of either.
    void check_ends(const ParticleBuffer& from, const ParticleBuffer& to) const;

  private:
    Program program_;
    BoundStorage bound_;
    std::size_t group_;                ///< invocations
    std::vector<bool> ends_with_last_; ///< by binding point
};

} // namespace lockstep
