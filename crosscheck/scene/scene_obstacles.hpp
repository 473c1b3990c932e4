#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

#include "crosscheck/files/json_reader.hpp"
#include "reference/model/mesh.hpp"

namespace lockstep {

/// Triangles that all obstacles of a scene may have together: a few numbers can ask for any number of them.
inline constexpr std::size_t most_triangles = std::size_t{1} << 22U;

/// One obstacle, placed and added to `mesh`. `folder`: mesh files are relative to it; without one a mesh is an Error.
/// `others`: keys of it that the system reads itself. Throws Error as load_scene does.
void read_obstacle(const JsonValue& json, const std::optional<std::filesystem::path>& folder, Mesh& mesh,
                   std::span<const std::string_view> others = {});

/// The obstacles of a scene file, in its order.
Mesh read_obstacles(const JsonValue& json, const std::optional<std::filesystem::path>& folder);

} // namespace lockstep
