#pragma once
#include <string>

#include "gpu/shader_source.hpp"

namespace lockstep {

/// Whether a text is in another dialect than the driver's: GLSL ES, GLSL before 3.30, or GLSL with words of Vulkan
/// (GL_KHR_vulkan_glsl).
bool is_other_dialect(const std::string& text);

/// A uniform vec2 of a stage whose inputs are computed: 1 / the image's size.
inline constexpr const char* texel_size_uniform = "u_LockstepTexel";

/// The stage in desktop GLSL 4.50, by glslang and spirv-cross; lines come from where they came from before. Names of
/// blocks, images, uniforms, inputs and outputs stay; push constants are a uniform block, and what the text binds to a
/// number goes by its name alone. An image and the one sampler that it is read with are one, by the image's name.
/// Inputs of ShaderSource::given are none. Throws Error `shader FILE:LINE: ...` for what glslang refuses, or what
/// desktop GLSL has no word for.
ShaderSource in_desktop_glsl(ShaderSource stage);

} // namespace lockstep
