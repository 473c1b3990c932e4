#pragma once
#include <filesystem>
#include <optional>

#include "crosscheck/json_reader.hpp"
#include "reference/model/mesh.hpp"

namespace lockstep {

/// The obstacles of a scene file, placed, in its order. `folder`: mesh files are relative to it; without one a mesh is
/// an Error. Throws Error as load_scene does.
Mesh read_obstacles(const JsonValue& json, const std::optional<std::filesystem::path>& folder);

} // namespace lockstep
