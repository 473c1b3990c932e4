#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gpu/bound_storage.hpp"
#include "gpu/collision/collision_texture.hpp"
#include "gpu/collision/collision_trace.hpp"
#include "gpu/collision/particle_buffer.hpp"
#include "gpu/object.hpp"
#include "gpu/program.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// The trace build of a compute stage that steps particles: the same file with LOCKSTEP_TRACE defined, run on one
/// particle. Its storage buffer at trace_binding is an array of structures whose members named trace_* are found by
/// introspection; invocation i tells in trace_neighbour_* of the i-th texel that is looked at.
class ComputeTrace {
  public:
    /// Sets a pass's uniforms, but for u_ParticleCount.
    using SetUniforms = void (*)(const Program&, const FrameParams&);

    /// `shaders` is looked into first; may be empty. Throws Error where the trace build does not compile or link.
    ComputeTrace(const std::string& pass, SetUniforms set_uniforms, const Switches& switches,
                 const std::filesystem::path& shaders, int width, int height);

    /// Steps particle `particle` of `from`, reading `cdt`. Of a shader without such a buffer the state alone is told.
    [[nodiscard]] StepCapture run(const FrameParams& params, const ParticleBuffer& from, std::size_t particle,
                                  const CollisionTexture& cdt);

  private:
    /// A member of the structure.
    struct Member {
        std::string name;
        GLenum type = 0;
        std::size_t offset = 0; ///< bytes from the structure's start
    };
    void find_members();
    void dispatch(const FrameParams& params, const ParticleBuffer& from, std::size_t particle,
                  const CollisionTexture& cdt, std::size_t invocations);
    /// What the first structures hold.
    [[nodiscard]] std::vector<CapturedVertex> told(std::size_t invocations) const;

    Program program_;
    SetUniforms set_uniforms_;
    BoundStorage bound_;
    std::vector<Member> members_;
    std::size_t stride_ = 0; ///< bytes from one structure to the next
    std::size_t group_ = 1;  ///< invocations
    int width_, height_;
    std::optional<ParticleBuffer> after_;
    GlBuffer traces_, nearest_, offers_;
};

} // namespace lockstep
