#pragma once
#include <filesystem>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "reference/model/lights/settings.hpp"

namespace lockstep::lights {

/// Reads a scene of system lights, and what the command line changes of it. Throws Error, naming the place.
Settings read_scene(const JsonValue& json, const SceneOptions& options = {});

/// The same from a file.
Settings load_scene(const std::filesystem::path& file, const SceneOptions& options = {});

} // namespace lockstep::lights
