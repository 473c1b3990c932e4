#pragma once
#include <string>
#include <string_view>

#include "crosscheck/judge/registered_system.hpp"
#include "reference/model/lights/host.hpp"

namespace lockstep::lights {

inline constexpr std::string_view meaning = "particles that are lights, through two 3D textures";

/// The twins of a run with its start and its named mistakes.
System system(const HostPtr& host, const std::string& name = "lights");

/// A scene file of system lights on both sides.
SystemScene load(const JsonValue& scene, const std::string& name, const SceneOptions& options);

} // namespace lockstep::lights
