#pragma once
#include <string>

namespace lockstep {

/// The limits of this process that drivers are known to fail on, as a clause: "memory is limited to 400000 KiB (ulimit
/// -v)"; empty: there are none.
std::string tight_limits();

/// Whether as many threads as a software rasteriser wants can be started: they are, for a moment.
bool can_start_driver_threads();

/// Before a GL library is opened. What of the environment may make a driver crash or hang, as a clause: variables that
/// choose one, tight limits; empty: nothing does. Where threads cannot be started, llvmpipe is asked to do without
/// (LP_NUM_THREADS).
std::string prepare_for_driver();

} // namespace lockstep
