#pragma once
#include <filesystem>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "reference/model/dust/settings.hpp"

namespace lockstep::dust {

/// The settings of a scene: preset, then `stage` of the section `dust`, then single switches;
/// `options.set` has switches alone, "one_hit=off". Throws Error as
/// `FILE: /json/pointer: what is wrong`, and as check(settings) does.
Settings read_scene(const JsonValue& json, const SceneOptions& options = {});
Settings load_scene(const std::filesystem::path& file, const SceneOptions& options = {});

} // namespace lockstep::dust
