#pragma once
#include "crosscheck/judge/system.hpp"
#include "reference/model/dust/host.hpp"

namespace lockstep::dust {

/// The dust system as a check sees it: its state, the kernels' twins, its named mistakes, and the start that the
/// settings give. gpu/dust/passes.hpp has its other side.
System system(const HostPtr& host);

} // namespace lockstep::dust
