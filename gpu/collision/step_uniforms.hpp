#pragma once
#include "gpu/program.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// Sets what every pass that steps particles needs to answer a hit and to integrate: range and time of a collision,
/// speed factor, tick, gravity.
void set_step_uniforms(const Program& program, const FrameParams& params);

/// Sets what a search through the CDT needs: the collision camera, the image's size, the window's radius, and the
/// uniforms of shaders/collision/collision_code.glsl.
void set_search_uniforms(const Program& program, const FrameParams& params);

/// Sets the uniforms of shaders/collision/collision_code.glsl.
void set_collision_code(const Program& program, const FrameParams& params);

} // namespace lockstep
