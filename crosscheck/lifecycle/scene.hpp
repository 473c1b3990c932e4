#pragma once
#include <filesystem>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "reference/model/lifecycle/settings.hpp"

namespace lockstep::lifecycle {

/// The settings of a scene: preset, then single switches; `options.set` has switches alone, "layout=112", and
/// `options.particles` is every emitter's capacity. Throws Error as `FILE: /json/pointer: what is wrong`.
Settings read_scene(const JsonValue& json, const SceneOptions& options = {});
Settings load_scene(const std::filesystem::path& file, const SceneOptions& options = {});

} // namespace lockstep::lifecycle
