#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/gl.hpp"
#include "gpu/interface_block.hpp"

namespace lockstep {

enum class Stage; // shader_source.hpp

/// What a SPIR-V module declares, by the names that it keeps: GL tells none of such a program (GL_ARB_gl_spirv). Names
/// are those that spirv-cross gives them in GLSL; blocks go by the names of their types.
struct SpirvModule {
    /// An input, an output, or a uniform outside of blocks.
    struct Variable {
        std::string name;
        GLenum type = 0;
        GLint size = 1; ///< elements of an array
        GLint location = -1;
        bool is_initialised = false;
        std::uint32_t id = 0; ///< of the variable, or of the structure whose member it is
        int member = -1;      ///< of an output block
    };
    std::string file; ///< as messages name it
    std::vector<std::uint32_t> words;
    std::string entry_point;
    bool says_precise = false; ///< NoContraction, of something
    bool asks_length = false;  ///< of an array without a size (OpArrayLength)
    bool calls_normalize = false;
    bool calls_inverse_sqrt = false;
    std::vector<Variable> inputs, outputs, uniforms;
    std::vector<InterfaceBlock> uniform_blocks, storage_blocks;

    [[nodiscard]] const Variable* output(std::string_view name) const;
    [[nodiscard]] std::vector<std::string> names() const; ///< all of these, and their blocks'
};

/// Whether a file's content begins as a module does, in either order of bytes.
bool is_spirv(std::string_view content);

/// Uniforms without a location get one that is free. Throws Error naming `file` and the remedy for what is no module,
/// is of another stage, has no names, or needs what GL does not have: that of Vulkan.
SpirvModule read_spirv(const std::string& file, std::string_view content, Stage stage);

/// The words of a module with which transform feedback captures `outputs`, and nothing else, interleaved into buffer 0.
std::vector<std::uint32_t> capturing(const SpirvModule& module, std::span<const SpirvModule::Variable> outputs);

/// The same shader as GLSL 4.50. `located`: what goes from stage to stage does by location, else by name.
std::string glsl_of(const SpirvModule& module, bool located);

} // namespace lockstep
