#pragma once
#include "crosscheck/judge/registered_system.hpp"
#include "reference/model/dust/host.hpp"

namespace lockstep::dust {

/// How grains are drawn in a frame, with the tool's cone, colliders and the world as lines.
SystemPicture picture(const HostPtr& host, const SystemState& state, int frame);

} // namespace lockstep::dust
