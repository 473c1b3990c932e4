#pragma once
#include <filesystem>
#include <utility>
#include <vector>

#include "gpu/bound_storage.hpp"
#include "gpu/collision/collision_texture.hpp"
#include "gpu/collision/particle_buffer.hpp"
#include "gpu/object.hpp"
#include "gpu/pass_timer.hpp"
#include "gpu/program.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// The storage buffers of shaders/collision/collision_pass.comp and of what draws after it (docs/own_shader.md).
enum StorageBinding : GLuint {
    before_binding,
    after_binding,
    nearest_binding, ///< two words a texel: particle, depth; both 2^32 - 1 where nobody was offered
    offers_binding,  ///< two words a particle: texel, depth
    trace_binding,   ///< what the trace build tells
};

/// bind_storage of a linked compute stage, whose blocks are Before, After, Nearest and Offers.
BoundStorage bind_particles(const Program& program);

/// The collision pass in compute stages (switch step = compute): shaders/collision/clear_nearest.comp empties the
/// texels (a driver's own clear of the buffer takes ten times as long; docs/speed.md), collision_pass.comp steps the
/// particles and offers each to its texel, nearest_particle.comp finds the lowest index among the nearest where that
/// takes a pass of its own, and collision_texels.* draws the texels. Twin of reference/collision/collision_pass.hpp.
class ComputeCollisionPass {
  public:
    /// `shaders` is looked into before the shipped folder; may be empty. Throws Error where the context has no compute
    /// shaders (GL 4.3), or no storage buffer large enough.
    ComputeCollisionPass(const Scene& scene, const std::filesystem::path& shaders);

    /// Steps `from` into `to`, reading `cdt`, drawing into `target` on top of what it holds.
    void run(const FrameParams& params, const ParticleBuffer& from, ParticleBuffer& to, const CollisionTexture& cdt,
             CollisionTexture& target, PassTimer& timer);

    /// Throws Error if a stage of the last run, which had the same arguments, wrote behind the end of a storage buffer.
    void check_ends(const FrameParams& params, const ParticleBuffer& from, ParticleBuffer& to,
                    const CollisionTexture& cdt, CollisionTexture& target);

  private:
    /// A program, and of which of its blocks it asks a length(), by binding point.
    struct Linked {
        explicit Linked(Program linked)
            : program(std::move(linked)), ends_with_last(lengths_asked(program, trace_binding)) {}
        Program program;
        std::vector<bool> ends_with_last;
    };
    /// Those that the stages have now, by binding point.
    [[nodiscard]] std::vector<StorageRange> ranges(const ParticleBuffer& from, const ParticleBuffer& to) const;
    void bind(const Linked& stage, const std::vector<StorageRange>& all) const;
    /// Where stages are looked at one by one.
    void check_stage(const Linked& stage, const std::vector<StorageRange>& all) const;
    void step(const FrameParams& params, const ParticleBuffer& from, const ParticleBuffer& to,
              const CollisionTexture& cdt, PassTimer& timer);
    void draw(const FrameParams& params, std::size_t particles, CollisionTexture& target);

    Linked clear_, step_, nearest_, draw_;
    BoundStorage bound_, nearest_bound_;
    std::size_t texels_;
    std::size_t clear_group_, step_group_, nearest_group_; ///< invocations
    bool has_offers_;                                      ///< step_ leaves the lowest index to nearest_
    bool checks_each_ = false;                             ///< whether a stage wrote behind an end, before the next
    StorageBuffer nearest_particles_, offers_;
    GlVertexArray no_attributes_;
};

} // namespace lockstep
