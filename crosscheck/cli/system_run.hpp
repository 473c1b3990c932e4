#pragma once
#include <string>

#include <nlohmann/json.hpp>

#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/cli/systems.hpp"
#include "crosscheck/judge/registered_system.hpp"
#include "gpu/shader_use.hpp"
#include "lockstep/system.hpp"

/// What the verbs on a scene of a registered system begin with.
namespace lockstep {

/// A scene file, read once.
struct ReadScene {
    std::string file;
    nlohmann::json document;
    SystemScene scene;
};

/// Reads the scene and sets the thread count.
ReadScene read_scene(const RegisteredSystem& system, const RunOptions& run);

/// Whose shaders will run. Throws Error like check_shader_use.
ShaderUse shaders_of(const SystemScene& scene, const RunOptions& run);

/// Throws Error where the GL that was asked for is not there.
Gl open_gl(const RunOptions& run);

/// `gl` and `scene` outlive it.
GlSystemSide side_of(const Gl& gl, const SystemScene& scene, const RunOptions& run);

GlSystemSide side_of(const Gl& gl, const SystemPicture& picture, const SystemScene& scene, const RunOptions& run);

// Pictures of a frame's state, which the scene has.
ColorImage reference_picture(const SystemScene& scene, const SystemState& state, int frame, const Profile& profile);
ColorImage gpu_picture(const Gl& gl, const SystemScene& scene, const SystemState& state, int frame,
                       const RunOptions& run);

} // namespace lockstep
