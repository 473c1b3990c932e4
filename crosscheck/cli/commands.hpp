#pragma once
#include <CLI/CLI.hpp>

namespace lockstep {

/// Exit statuses of the program.
inline constexpr int status_agree = 0;
inline constexpr int status_differ = 1;
inline constexpr int status_could_not_run = 2;
inline constexpr int status_interrupted = 130; ///< Ctrl-C, as a shell reports it

/// Each adds one verb; its callback leaves the exit status in `status`, or throws Error.
void add_check_command(CLI::App& app, int& status);
void add_report_command(CLI::App& app, int& status);
void add_explain_command(CLI::App& app, int& status);
void add_debug_command(CLI::App& app, int& status);
void add_render_command(CLI::App& app, int& status);
void add_hash_command(CLI::App& app, int& status);
void add_probe_command(CLI::App& app, int& status);
void add_info_command(CLI::App& app, int& status);
void add_bench_command(CLI::App& app, int& status);
void add_study_command(CLI::App& app, int& status);
void add_record_command(CLI::App& app, int& status);
void add_trace_command(CLI::App& app, int& status);
void add_completion_command(CLI::App& app, int& status);
void add_manual_command(CLI::App& app, int& status);
void add_capsule_command(CLI::App& app, int& status);

} // namespace lockstep
