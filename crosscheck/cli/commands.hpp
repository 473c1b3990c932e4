#pragma once
#include "crosscheck/cli/verb.hpp"

namespace lockstep {

/// Exit statuses of the program.
inline constexpr int status_agree = 0;
inline constexpr int status_differ = 1;
inline constexpr int status_could_not_run = 2;
inline constexpr int status_interrupted = 130; ///< Ctrl-C, as a shell reports it

Verb check_command();
Verb report_command();
Verb explain_command();
Verb debug_command();
Verb render_command();
Verb hash_command();
Verb probe_command();
Verb info_command();
Verb bench_command();
Verb study_command();
Verb record_command();
Verb trace_command();
Verb completion_command();
Verb manual_command();
Verb capsule_command();

} // namespace lockstep
