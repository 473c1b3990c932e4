#pragma once
#include <cstddef>
#include <filesystem>
#include <vector>

#include "gpu/bound_storage.hpp"
#include "gpu/collision/octree.hpp"
#include "gpu/collision/particle_buffer.hpp"
#include "gpu/object.hpp"
#include "gpu/program.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// The octree comparator on GL (thesis, chapter 5): the tree is refreshed on the CPU from particles that were read
/// back, nodes and particles lie in storage buffers, and shaders/collision/octree_pass.comp searches through a node
/// texture. Twin of reference/collision/octree_pass.hpp.
class OctreePass {
  public:
    /// `shaders`: a folder looked into before the shipped one, or empty. Throws Error where the context has no compute
    /// shaders (GL 4.3), or no storage buffer large enough.
    OctreePass(const Scene& scene, const std::filesystem::path& shaders);

    /// The thesis's octree pass: reads `particles` back, fills the tree and brings it to the GPU.
    void refresh(const ParticleBuffer& particles);

    /// The thesis's particle pass: steps `from`, which the tree was refreshed from, into `to`.
    void run(const FrameParams& params, const ParticleBuffer& from, ParticleBuffer& to);

    /// Throws Error if the last run wrote behind the end of a storage buffer.
    void check_ends(const ParticleBuffer& from, const ParticleBuffer& to) const;

  private:
    Program program_;
    BoundStorage bound_;
    std::size_t group_;                ///< invocations
    std::vector<bool> ends_with_last_; ///< by binding point
    Octree octree_;
    std::vector<glm::vec3> obstacles_; ///< vertices that take part
    Particles read_back_;
    GlTexture node_texture_;
    StorageBuffer nodes_, indices_, order_, obstacle_vertices_;
};

} // namespace lockstep
