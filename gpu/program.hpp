#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "gpu/gl.hpp"
#include "gpu/interface_block.hpp"
#include "gpu/program_interface.hpp"
#include "gpu/shader_source.hpp"

namespace lockstep {

/// An output that transform feedback captures; type as GL names it (GL_FLOAT_VEC3).
struct Capture {
    std::string name;
    GLenum type = GL_FLOAT;
    GLint size = 1; ///< elements of an array
};

/// The outputs of the last vertex-processing stage whose names start with `prefix`, by name: what the linked program
/// says of each such word in the stage's text. Throws Error where a stage does not compile.
std::vector<Capture> outputs_with(std::string_view prefix, std::span<const ShaderSource> stages);

/// Throws Error for an output of the last vertex-processing stage named like a captured one (out_*) that is neither
/// among `captured` nor read by the fragment stage: whoever wrote it takes it for compared.
void check_nothing_lost(std::span<const ShaderSource> stages, std::span<const Capture> captured);

/// A linked program. Whatever is wrong with a shader is an Error of one line: `shader FILE:LINE: ...` where a stage
/// does not compile or declares something as another type, `NAME: ...` for the rest. Where bindings lie beside the
/// stages, uniforms, attributes and captured outputs go by the names that are given there. SPIR-V modules are handed to
/// GL where all stages are such (GL_ARB_gl_spirv), and are translated to GLSL beside stages that are GLSL.
class Program {
  public:
    /// Links `stages`; `captured` outputs of the last vertex-processing stage go interleaved, in this order, into the
    /// buffer bound to transform feedback. Throws Error also for a captured output that is missing or of another type,
    /// for a block that nobody binds, and for a fragment stage that writes no output 0. A compute stage binds its
    /// storage buffers by number; other stages have those of these names, if any.
    Program(std::string name, std::span<const ShaderSource> stages, std::span<const Capture> captured = {},
            std::span<const std::string_view> storage_buffers = {});
    Program(Program&& other) noexcept;
    Program& operator=(Program&& other) noexcept;
    ~Program();

    void use() const;

    /// Sets a uniform and leaves the program in use. One the program does not use is no error; one of another type is.
    void set(std::string_view uniform, float value) const;
    void set(std::string_view uniform, int value) const;
    void set(std::string_view uniform, unsigned value) const;
    void set(std::string_view uniform, bool value) const;
    void set(std::string_view uniform, glm::vec2 value) const;
    void set(std::string_view uniform, glm::vec3 value) const;
    void set(std::string_view uniform, glm::vec4 value) const;
    void set(std::string_view uniform, glm::ivec2 value) const;
    void set(std::string_view uniform, glm::ivec3 value) const;
    void set(std::string_view uniform, glm::ivec4 value) const;
    void set(std::string_view uniform, glm::uvec2 value) const;
    void set(std::string_view uniform, glm::uvec3 value) const;
    void set(std::string_view uniform, glm::uvec4 value) const;
    void set(std::string_view uniform, const glm::mat2& value) const;
    void set(std::string_view uniform, const glm::mat3& value) const;
    void set(std::string_view uniform, const glm::mat4& value) const;

    /// Reads a sampler or image uniform from texture (or image) unit `unit`.
    void set_unit(std::string_view uniform, int unit, GLenum type = GL_SAMPLER_2D) const;

    /// Location of a vertex attribute, -1 if the program does not use it. Throws Error if it has another type.
    [[nodiscard]] GLint attribute(std::string_view attribute, GLenum type) const;

    /// Throws Error if the shader uses a uniform that was never set and has no initialiser, or an attribute that was
    /// never asked for: a misspelt name would otherwise read as 0.
    void check_interface() const;

    /// Whether a storage buffer with this binding takes part. Needs GL 4.3.
    [[nodiscard]] bool uses_storage(GLuint binding) const;
    /// Its active storage blocks, in GL's order. Needs GL 4.3.
    [[nodiscard]] std::vector<InterfaceBlock> storage_blocks() const;

    /// The file of its first stage, as messages name it.
    [[nodiscard]] const std::string& file() const { return file_; }
    /// Whether a stage asks the length() of an array of the block.
    [[nodiscard]] bool asks_length(const InterfaceBlock& block) const;

    /// What lies beside its stages; null: nothing.
    [[nodiscard]] const std::shared_ptr<const Bindings>& bindings() const { return bindings_; }

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] GLuint id() const { return id_; }

  private:
    void link_texts(std::span<const ShaderSource> stages, std::span<const Capture> outputs,
                    std::span<const std::string_view> storage_buffers);
    void link_modules(std::span<const ShaderSource> stages, std::span<const Capture> outputs,
                      std::span<const std::string_view> storage_buffers);
    void set_words(std::string_view uniform, GLenum type, std::span<const std::uint32_t> words) const;

    std::string name_, file_;
    std::set<std::string> lengths_asked_; ///< by its stages
    GLuint id_ = 0;
    std::shared_ptr<const Bindings> bindings_;
    std::vector<InterfaceBlock> module_blocks_; ///< of SPIR-V, in GL's order
    std::optional<UniformValues> uniforms_;
    ProgramInterface attributes_{"attribute"};
};

} // namespace lockstep
