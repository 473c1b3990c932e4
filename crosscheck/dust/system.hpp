#pragma once
#include <string>

#include "crosscheck/judge/registered_system.hpp"
#include "reference/model/dust/host.hpp"

namespace lockstep::dust {

/// The dust system as a check sees it: its state, the kernels' twins, its named mistakes, and the start that the
/// settings give. gpu/dust/passes.hpp has its other side.
System system(const HostPtr& host, const std::string& name = "dust");

/// A scene of the system, for the verbs (registered_system.hpp).
SystemScene load(const JsonValue& scene, const std::string& name, const SceneOptions& options);

} // namespace lockstep::dust
