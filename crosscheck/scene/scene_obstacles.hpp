#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>

#include "crosscheck/files/json_reader.hpp"
#include "reference/model/mesh.hpp"

namespace lockstep {

/// Triangles that all obstacles of a scene may have together: a few numbers can ask for any number of them.
inline constexpr std::size_t most_triangles = std::size_t{1} << 22U;

/// The obstacles of a scene file, placed, in its order. `folder`: mesh files are relative to it; without one a mesh is
/// an Error. Throws Error as load_scene does.
Mesh read_obstacles(const JsonValue& json, const std::optional<std::filesystem::path>& folder);

} // namespace lockstep
