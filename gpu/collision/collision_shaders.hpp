#pragma once
#include "gpu/shader_source.hpp"

namespace lockstep {

/// Where the passes' shaders lie: `user` (--shaders DIR) first, if it is given.
inline ShaderFolders collision_shaders(const std::filesystem::path& user) { return shader_folders(user, "collision"); }

} // namespace lockstep
