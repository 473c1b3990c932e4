#pragma once

namespace lockstep {

/// First thing in main: lets OpenMP's threads sleep while they wait. By default they spin, on the cores that a software
/// driver's own threads need, which costs `check` more than the reference itself. OpenMP reads OMP_WAIT_POLICY before
/// main, so the program starts itself once more with it set; a policy that the user set stays.
void let_waiting_threads_sleep(char** argv);

} // namespace lockstep
