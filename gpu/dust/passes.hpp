#pragma once
#include <vector>

#include "gpu/gl_system.hpp"
#include "reference/model/dust/drawing.hpp"
#include "reference/model/dust/host.hpp"

namespace lockstep::dust {

/// The kernels on GL and what the host hands them, in the order of a frame; each with the pass that its count is.
std::vector<GlPass> passes(const HostPtr& host);

/// The vertex stage that draws them, for drawn_schema().
GlPass draw_gl_pass(const HostPtr& host, const Drawing& drawing);

} // namespace lockstep::dust
