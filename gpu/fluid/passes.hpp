#pragma once
#include <vector>

#include "gpu/gl_system.hpp"
#include "reference/model/fluid/host.hpp"

namespace lockstep::fluid {

/// The shaders of a frame with their uniforms, in the order of its twins.
std::vector<GlPass> passes(const HostPtr& host);

} // namespace lockstep::fluid
