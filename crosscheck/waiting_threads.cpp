#include "crosscheck/waiting_threads.hpp"

#include <cstdlib>

#include <unistd.h>

namespace lockstep {

void let_waiting_threads_sleep(char** argv) {
    if (std::getenv("OMP_WAIT_POLICY") != nullptr || setenv("OMP_WAIT_POLICY", "passive", 1) != 0)
        return;
    execv("/proc/self/exe", argv); // returns only where it failed: then they spin
}

} // namespace lockstep
