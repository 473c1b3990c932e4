#pragma once
#include <string>
#include <string_view>

#include "crosscheck/judge/registered_system.hpp"
#include "reference/model/lifecycle/host.hpp"

namespace lockstep::lifecycle {

inline constexpr std::string_view meaning = "particles that are born, move, die and are packed, by compute shaders";

/// The lifecycle system as a check sees it: no particle at first. gpu/lifecycle/passes.hpp has its other side.
System system(const HostPtr& host, const std::string& name = "lifecycle");

/// A scene of the system, for the verbs (registered_system.hpp).
SystemScene load(const JsonValue& scene, const std::string& name, const SceneOptions& options);

} // namespace lockstep::lifecycle
