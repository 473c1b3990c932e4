#pragma once
#include "crosscheck/judge/registered_system.hpp"
#include "reference/model/lifecycle/host.hpp"

namespace lockstep::lifecycle {

/// How the living are drawn: sprites, and ribbons with a pattern along them.
SystemPicture picture(const HostPtr& host, const SystemState& state, int frame);

} // namespace lockstep::lifecycle
