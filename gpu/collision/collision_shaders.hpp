#pragma once
#include <filesystem>
#include <vector>

#include "gpu/shader_source.hpp"
#include "gpu/shader_use.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// Where the passes' shaders lie: `user` (--shaders DIR) first, if it is given.
ShaderFolders collision_shaders(const std::filesystem::path& user);

/// For every switch with named values: a number for each value and the one that is set (choice_defines).
ShaderDefines switch_defines(const Switches& switches);

/// The passes that run in a scene, and their stages. `rendered`: the rendered frame is drawn, too.
std::vector<PassStages> collision_stages(const Scene& scene, bool rendered = false);

/// Which shaders run in a scene, of `user` (empty: none) and the shipped ones. Throws Error like load_stages.
ShaderUse shader_use(const Scene& scene, const std::filesystem::path& user, bool rendered = false);

/// Links those of the user's shaders that draw the rendered frame, for a run that draws none. Throws Error like
/// Program.
void compile_unrendered(const Scene& scene, const std::filesystem::path& user);

} // namespace lockstep
