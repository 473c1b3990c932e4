#pragma once
#include <string>
#include <vector>

#include "reference/model/schema.hpp"

namespace lockstep {

/// Where things stand in a trace (docs/traces.md), as H5MD 1.1 has it.
namespace layout {

/// The group of a field; its dataset `value` is [rows][items] of the field's type, and [components] where there are
/// several. Row 0 is the start, row k the state after frame k - 1.
std::string group(const Resource& buffer, const Field& field);
std::string value(const Resource& buffer, const Field& field);

/// float32 [rows][particles][3], where there are no directions and speeds: one vector (Velocity, switches.hpp).
inline constexpr const char* velocity = "particles/all/velocity/value";

/// Stored codes: float32 [frames][height][width][4], the bottom row first; row k is the CDT after frame k.
inline constexpr const char* cdt = "observables/cdt/value";

/// int32 [frames]: how many particles there are in each; missing: all.
inline constexpr const char* counts = "observables/count/value";

/// Texts.
inline constexpr const char* scene = "parameters/lockstep/scene"; ///< of a scene file
inline constexpr const char* name = "parameters/lockstep/name";   ///< the scene's
inline constexpr const char* profile = "parameters/lockstep/profile";
inline constexpr const char* renderer = "parameters/lockstep/renderer";
inline constexpr const char* settings = "parameters/lockstep/settings";
inline constexpr const char* shaders = "parameters/lockstep/shaders";
inline constexpr const char* probe = "parameters/lockstep/probe";

// Of a run of a registered system, or of one of somebody's own:
/// "state/light": its group of a buffer or image. `frame` and `pass` there are int32 [rows], of each row the frame and
/// pass that left it, -1 of row 0, the start.
std::string state(const Resource& resource);
/// [rows][items], of an image [rows][layers][height][width], the layers where it has three dimensions; then
/// [components] where there are several.
std::string state_value(const Resource& resource, const Field& field);
inline constexpr const char* system = "parameters/lockstep/system";   ///< its schema's name
inline constexpr const char* schema = "parameters/lockstep/schema";   ///< JSON (schema_json.hpp)
inline constexpr const char* options = "parameters/lockstep/options"; ///< JSON: what was changed in the scene
inline constexpr const char* frames = "parameters/lockstep/frames";   ///< how many, in decimal digits

/// Obstacles in the world: float32 [corners][3], and the three corners of each triangle, uint32 [triangles][3].
inline constexpr const char* obstacle_positions = "parameters/lockstep/obstacles/positions";
inline constexpr const char* obstacle_triangles = "parameters/lockstep/obstacles/triangles";

/// The driver's tables (root_tables.hpp): int8, units in the last place from the rounded value.
inline constexpr const char* reciprocals = "parameters/lockstep/roots/reciprocal";
inline constexpr const char* inverse_sqrts = "parameters/lockstep/roots/inverse_sqrt";

} // namespace layout
} // namespace lockstep
