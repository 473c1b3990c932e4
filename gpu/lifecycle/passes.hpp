#pragma once
#include <vector>

#include "gpu/gl_system.hpp"
#include "reference/model/lifecycle/drawing.hpp"
#include "reference/model/lifecycle/host.hpp"

namespace lockstep::lifecycle {

/// The kernels on GL and what the host hands them, in the order of a frame, emitter after emitter; each with the passes
/// that its dispatch makes besides.
std::vector<GlPass> passes(const HostPtr& host);

/// The vertex stage that draws the living, for drawn_schema().
GlPass draw_gl_pass(const HostPtr& host, const Drawing& drawing);

} // namespace lockstep::lifecycle
