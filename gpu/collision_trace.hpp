#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "gpu/collision_texture.hpp"
#include "gpu/particle_buffer.hpp"
#include "gpu/program.hpp"
#include "reference/model/particles.hpp"
#include "reference/model/scene.hpp"

namespace lockstep {

/// A captured output, bit for bit.
struct CapturedOutput {
    std::string name;
    std::string type;                 ///< as GLSL names it
    bool is_float = true;             ///< else integers
    std::vector<std::uint32_t> words; ///< its components

    [[nodiscard]] float number(std::size_t component) const;
    [[nodiscard]] std::int32_t integer(std::size_t component) const;
};

/// Captured outputs of one vertex.
class CapturedVertex {
  public:
    std::vector<CapturedOutput> outputs;

    /// Null where there is none of that name and type.
    [[nodiscard]] const CapturedOutput* find(std::string_view name, std::string_view type) const;
    [[nodiscard]] std::optional<float> real(std::string_view name) const;
    [[nodiscard]] std::optional<std::int32_t> integer(std::string_view name) const;
    [[nodiscard]] std::optional<glm::ivec2> integers(std::string_view name) const;
    [[nodiscard]] std::optional<glm::vec2> vec2(std::string_view name) const;
    [[nodiscard]] std::optional<glm::vec3> vec3(std::string_view name) const;
    [[nodiscard]] std::optional<glm::vec4> vec4(std::string_view name) const;
};

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
    CollisionTrace(const Switches& switches, const std::filesystem::path& shaders, int width, int height);

    /// Steps particle `particle` of `from`, reading `cdt`.
    [[nodiscard]] StepCapture run(const FrameParams& params, const ParticleBuffer& from, std::size_t particle,
                                  const CollisionTexture& cdt);

  private:
    /// Outputs that one draw can capture, and the program that does.
    struct Part {
        std::vector<Capture> captured;
        Program program;
    };
    static std::vector<Part> parts(const std::string& name, std::span<const ShaderSource> stages,
                                   std::span<const Capture> captured);
    static std::vector<CapturedVertex> capture(const Part& part, const FrameParams& params, const ParticleBuffer& from,
                                               std::size_t particle, int instances);
    void capture_vertex_stage(const FrameParams& params, const ParticleBuffer& from, std::size_t particle,
                              StepCapture& step) const;
    void capture_whole_pass(const FrameParams& params, const ParticleBuffer& from, std::size_t particle,
                            StepCapture& step);

    CollisionTexture target_;
    std::vector<Part> vertex_stage_; ///< the vertex stage by itself
    std::vector<Part> whole_pass_;
};

} // namespace lockstep
