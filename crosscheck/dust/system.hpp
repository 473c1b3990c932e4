#pragma once
#include <string>
#include <string_view>

#include "crosscheck/judge/registered_system.hpp"
#include "reference/model/dust/host.hpp"

namespace lockstep::dust {

inline constexpr std::string_view meaning = "grains that tools, balls and colliders move, by compute shaders";

/// The dust system as a check sees it: its state, the kernels' twins, its named mistakes, and the start that the
/// settings give. gpu/dust/passes.hpp has its other side.
System system(const HostPtr& host, const std::string& name = "dust");

/// A scene of the system, for the verbs (registered_system.hpp).
SystemScene load(const JsonValue& scene, const std::string& name, const SceneOptions& options);

} // namespace lockstep::dust
