#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "gpu/shader_source.hpp"

namespace lockstep {

/// glslang's SPIR-V for OpenGL of a stage in GLSL, with names and lines; the words of one that is SPIR-V already.
/// Throws Error `shader FILE:LINE: ...` with glslang's first message.
std::vector<std::uint32_t> spirv_of(const ShaderSource& stage);

/// "FILE:LINE" of a line of the stage's text, the file's name alone.
std::string line_name(const ShaderSource& stage, std::uint32_t line);

} // namespace lockstep
