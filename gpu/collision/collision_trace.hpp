#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "gpu/collision/collision_texture.hpp"
#include "gpu/collision/particle_buffer.hpp"
#include "gpu/vertex_capture.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// What one particle's step computed on the GPU.
struct StepCapture {
    CapturedVertex vertex;                     ///< trace_* outputs of the vertex stage
    std::vector<CapturedVertex> neighbours;    ///< the trace_neighbour_* of each texel that was looked at, in order
    std::optional<ParticleState> vertex_state; ///< what the vertex stage hands on as v_* or out_*, if all of it
    CapturedVertex last;                       ///< trace_* outputs of the geometry stage, if there is one
    ParticleState state;                       ///< out_*, which the pass captures
    bool drawn_alone = true;                   ///< what follows is known
    glm::vec4 position{0.0F};                  ///< gl_Position of the last vertex-processing stage
    glm::ivec2 texel{-1};                      ///< the one the point alone is drawn to; -1: none
    float depth = 1.0F;
    glm::vec4 code{0.0F}; ///< what it stores there (image.hpp)
};

/// The trace build of the collision pass: the same files with LOCKSTEP_TRACE defined. Its outputs named trace_*, found
/// by introspection, are captured by transform feedback when one particle is drawn by itself. As many instances are
/// drawn as the output `trace_neighbour_count` says; instance i tells in outputs trace_neighbour_* of the i-th texel.
/// In a shader that knows nothing of LOCKSTEP_TRACE, whatever it names trace_* is captured just so.
class CollisionTrace {
  public:
    /// `shaders` is looked into first; may be empty. Throws Error where the trace build does not compile or link.
    CollisionTrace(const Switches& switches, const std::filesystem::path& shaders, int width, int height,
                   const ClipDepth& depth);

    /// Steps particle `particle` of `from`, reading `cdt`.
    [[nodiscard]] StepCapture run(const FrameParams& params, const ParticleBuffer& from, std::size_t particle,
                                  const CollisionTexture& cdt);

  private:
    void capture_vertex_stage(const FrameParams& params, const ParticleBuffer& from, std::size_t particle,
                              StepCapture& step) const;
    void capture_whole_pass(const FrameParams& params, const ParticleBuffer& from, std::size_t particle,
                            StepCapture& step);

    CollisionTexture target_;
    std::vector<VertexCapture> vertex_stage_; ///< the vertex stage by itself
    std::vector<VertexCapture> whole_pass_;
};

} // namespace lockstep
