#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gpu/shader_source.hpp"
#include "reference/text/program.hpp"

namespace lockstep {

/// What a module has of an expression of constants: its value, or the operation and its operands, which a watched run
/// then looks at.
enum class ConstantExpressions : std::uint8_t { folded, open };

/// glslang's SPIR-V for OpenGL of a stage in GLSL, with names and lines; the words of one that is SPIR-V already.
/// Throws Error `shader FILE:LINE: ...` with glslang's first message.
std::vector<std::uint32_t> spirv_of(const ShaderSource& stage,
                                    ConstantExpressions constants = ConstantExpressions::folded);

/// "FILE:LINE" of a line of the stage's text, the file's name alone.
std::string line_name(const ShaderSource& stage, std::uint32_t line);

/// A stage as the interpreter takes it, whose lines have the names above. Throws Error as spirv_of does, and for what
/// is not interpreted.
text::Program program_of(const std::shared_ptr<const ShaderSource>& stage);

/// The same without what no output depends on, by SPIRV-Tools' passes. It computes the same, by other steps: not for a
/// run that is shown.
text::Program live_program_of(const std::shared_ptr<const ShaderSource>& stage);

} // namespace lockstep
