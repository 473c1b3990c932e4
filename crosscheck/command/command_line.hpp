#pragma once
#include "crosscheck/command/verb.hpp"

namespace lockstep {

/// Reads the command line, lets its options keep their values, runs its verb, or the program where it has no verbs,
/// and returns the exit status. Help goes to standard output, with 0. What is wrong with the command line goes to
/// standard error in one line, with `misused`. What `run` throws is passed on.
int run_command_line(const Verb& program, int argc, char** argv, int misused);

} // namespace lockstep
