#pragma once
#include <string>

namespace lockstep {

/// Threads that may be asked for.
inline constexpr int most_threads = 1024;

/// Why the stack is too small to run in; empty: it is not. A driver's compiler runs on it, and OpenMP's threads get as
/// much each.
std::string stack_problem();

/// First thing in main: lets OpenMP's threads sleep while they wait. By default they spin, on the cores that a software
/// driver's own threads need, which costs `check` more than the reference itself. OpenMP reads OMP_WAIT_POLICY before
/// main, so the program starts itself once more with it set; a policy that the user set stays. GNU's OpenMP spins a
/// thousand times before it sleeps (some 20 microseconds), since one parallel loop often follows another at once.
void let_waiting_threads_sleep(char** argv);

/// The same for a program of other people's that lockstep is a part of, which cannot be started once more: holds a
/// second pool of threads that sleeps. GNU's OpenMP spins a thousand times instead of 300,000 where it has more threads
/// than there are cores. Only the first call does anything.
void have_waiting_threads_sleep_soon();

/// Starts the reference's threads, before a GL driver takes its own: `wanted` of them, 0 for what OpenMP would take.
/// Where so many cannot be started (limits on processes or memory, OMP_STACKSIZE), half of them, and so on; OpenMP
/// itself would end the program. Results are the same for any number. Only the first call tries.
void start_threads(int wanted);

} // namespace lockstep
