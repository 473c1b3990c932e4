#pragma once
#include <filesystem>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "reference/model/fluid/settings.hpp"

namespace lockstep::fluid {

/// Reads a scene of system fluid, and what the command line changes of it. Throws Error, naming the place.
Settings read_scene(const JsonValue& json, const SceneOptions& options = {});

/// The same from a file.
Settings load_scene(const std::filesystem::path& file, const SceneOptions& options = {});

} // namespace lockstep::fluid
