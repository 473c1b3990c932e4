#pragma once
#include <filesystem>

#include "gpu/shader_source.hpp"

namespace lockstep {

/// A stage's file, GLSL or with .spv behind its name SPIR-V, for what only reads it, and does not hand it to this
/// system's GL: GLSL ES, GLSL for Vulkan and any version, or none, come as they are.
ShaderSource load_any_dialect(const std::filesystem::path& file, Stage stage, const ShaderDefines& defines = {});

} // namespace lockstep
