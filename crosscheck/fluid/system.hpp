#pragma once
#include <string>
#include <string_view>

#include "crosscheck/judge/registered_system.hpp"
#include "reference/model/fluid/host.hpp"

namespace lockstep::fluid {

inline constexpr std::string_view meaning = "particles as a fluid's surface, drawn in screen space";

/// The twins of a run with its start and its named mistakes.
System system(const HostPtr& host, const std::string& name = "fluid");

/// A scene file of system fluid on both sides.
SystemScene load(const JsonValue& scene, const std::string& name, const SceneOptions& options);

} // namespace lockstep::fluid
