#pragma once
#include "gpu/context.hpp"

namespace lockstep {

/// Opens one kind of context in a child process, draws, and closes it again. Throws Error with the reason, without its
/// name; ChildFailed (child_process.hpp) if the driver crashes or hangs.
ContextInfo try_context(const ContextRequest& request);

/// Whether this process is such a child, where contexts are opened without another trial.
bool is_trial();

} // namespace lockstep
