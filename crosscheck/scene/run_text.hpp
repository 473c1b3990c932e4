#pragma once
#include <filesystem>
#include <string>

#include "crosscheck/scene/scene_file.hpp"

namespace lockstep {

/// The words of a command line that load a scene, its file as an absolute path; empty where no option of the command
/// line does (emitter_length).
std::string scene_arguments(const std::filesystem::path& file, const SceneOptions& options);

/// "arithmetic plain, CDT rgba32f 500x500, radius 1"
std::string switches_text(const Scene& scene);

} // namespace lockstep
