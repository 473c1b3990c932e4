#pragma once
#include "gpu/gl_system.hpp"
#include "reference/model/lifecycle/host.hpp"

namespace lockstep::lifecycle {

// What the shaders include of an emitter's graphs, and what these are handed; none where it has no graph. The files
// stand for those of shaders/lifecycle of the same names. Twin: reference/lifecycle/graphs.hpp.

/// emission_graph.glsl and simulation_graph.glsl.
ShaderTexts stage_texts(const Emitter& emitter);
void add_stage_parameters(Uniforms& all, const Emitter& emitter);

/// rendering_graph.glsl, for the quads of all emitters.
ShaderTexts rendering_texts(const Host& host);
/// RENDERING_GRAPH where there is one, and LOOKS_BY_VELOCITY and its like for what the graphs read of particles
/// besides.
ShaderDefines rendering_defines(const Host& host);
void add_rendering_parameters(Uniforms& all, const Host& host);

} // namespace lockstep::lifecycle
