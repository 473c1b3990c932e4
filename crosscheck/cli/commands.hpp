#pragma once
#include "crosscheck/command/exit_status.hpp"
#include "crosscheck/command/verb.hpp"

namespace lockstep {

Verb check_command();
Verb merge_command();
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
Verb graph_command();
Verb function_command();
Verb examine_command();
Verb new_command();

} // namespace lockstep
