#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/judge/system.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "gpu/gl_system.hpp"
#include "reference/model/arithmetic_switch.hpp"

namespace lockstep {

/// What a scene file of a registered system comes to, on both sides.
struct SystemScene {
    System system;              ///< the twins; its `settings` are what a report says of switches
    std::vector<GlPass> passes; ///< the shaders, in the twins' order
    ArithmeticSwitch arithmetic = ArithmeticSwitch::plain;
};

/// A system that scene files name: `"system": "dust"`. The verbs know no other thing of it.
struct RegisteredSystem {
    std::string_view name;    ///< its schema's, and its folders'
    std::string_view meaning; ///< one line, for people
    /// Reads a scene: all keys of the file but "system" and "description", `options` on top. `name`: the scene's.
    /// Throws Error as load_scene does.
    SystemScene (*load)(const JsonValue& scene, const std::string& name, const SceneOptions& options);
};

} // namespace lockstep
