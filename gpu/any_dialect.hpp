#pragma once
#include <string_view>

#include "gpu/shader_source.hpp"

namespace lockstep {

/// load_stage for what only reads the text, and does not hand it to this system's GL: GLSL ES, GLSL for Vulkan and any
/// version, or none, come as they are.
ShaderSource load_any_dialect(const ShaderFolders& folders, std::string_view name, Stage stage,
                              const ShaderDefines& defines = {});

} // namespace lockstep
