#pragma once
/// The verbs of `lockstep` for a system of one's own, as the main() of a program:
///
///     int main(int argc, char** argv) {
///         return lockstep::run_system_program(argc, argv, my_system, my_passes, SHADERS);
///     }
#include <functional>
#include <string>
#include <vector>

#include "lockstep/system.hpp"

namespace lockstep {

/// Runs `argv` (`PROGRAM --help` says what there is): check, explain, capsule, hash, record, trace and report, on GL
/// with the shaders of `--shaders`, otherwise those of `shaders`. Returns the exit status: 0 what was asked for agrees
/// or is legal, 1 it is not, 2 a message was printed that says what is wrong, 130 Ctrl-C. What `system` and `passes`
/// throw is such a message.
int run_system_program(int argc, char** argv, const std::function<System()>& system,
                       const std::function<std::vector<GlPass>()>& passes, const std::string& shaders);
int run_system_program(int argc, char** argv, const System& system, const std::vector<GlPass>& passes,
                       const std::string& shaders);

} // namespace lockstep
