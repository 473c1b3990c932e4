#pragma once

namespace lockstep {

/// Exit statuses of a program with verbs.
inline constexpr int status_agree = 0;
inline constexpr int status_differ = 1;
inline constexpr int status_could_not_run = 2;
inline constexpr int status_interrupted = 130; ///< Ctrl-C, as a shell reports it

} // namespace lockstep
