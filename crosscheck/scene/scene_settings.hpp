#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "crosscheck/files/json_reader.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// The keys of a scene file.
inline constexpr std::array<std::string_view, 17> scene_keys{
    "description", "system",           "seed",     "preset", "switches", "constants",  "camera",
    "camera_path", "collision_camera", "image",    "render", "cdt_box",  "clip_space", "frames",
    "start",       "emitters",         "obstacles"};

/// Reads everything of a scene file but its particles, obstacles and name. `preset`: instead of the file's. `set`:
/// "name=value", last of all. Throws Error as load_scene does.
void read_settings(const JsonValue& json, const std::optional<std::string>& preset, const std::vector<std::string>& set,
                   Scene& scene);

/// The same as JSON, complete: read_settings gives the same bits whatever the defaults and presets are then.
nlohmann::json settings_json(const Scene& scene);

/// A box with corners "min" and "max".
Box read_box(const JsonValue& json);

} // namespace lockstep
