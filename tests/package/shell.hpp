#pragma once
#include <string>

namespace lockstep::test {

struct ShellOutcome {
    int status = -1; ///< exit status; -1: ended by a signal
    std::string out; ///< standard output and error
};

/// Runs a command line as typed, lockstep's program in the path.
ShellOutcome run_in_shell(const std::string& command);

} // namespace lockstep::test
