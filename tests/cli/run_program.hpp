#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lockstep::test {

/// How a program ended, and what it said.
struct Outcome {
    int status = -1; ///< exit status; -1: ended by a signal
    int signal = 0;
    std::string out; ///< standard output; on a terminal, all that was shown
    std::string err; ///< standard error
};

struct Surroundings {
    std::vector<std::pair<std::string, std::string>> environment = {}; ///< set on top of the test's own
    std::optional<std::size_t> largest_file = {}; ///< bytes; a longer file fails as on a full disk (EFBIG for ENOSPC)
    std::optional<std::string> standard_output = {}; ///< a file instead of a pipe; empty: closed
    bool nobody_reads = false;                       ///< standard output is a pipe whose other end is closed
    std::optional<std::size_t> memory = {};          ///< bytes of address space
    std::optional<std::size_t> stack = {};           ///< bytes
    std::optional<std::size_t> processes = {};       ///< with their threads; root becomes a user who has none yet
    std::optional<std::size_t> files = {};           ///< that can be open
    std::vector<int> closed = {};                    ///< of the standard streams
    std::string folder = {};                         ///< to run in; empty: the test's
    std::optional<std::string> standard_input = {};  ///< through a pipe; at most what one holds, 64 KiB
};

/// Runs lockstep with `arguments`, standard output and error as pipes, and waits for its end.
Outcome run_lockstep(const std::vector<std::string>& arguments, const Surroundings& surroundings = {});

/// Sends `signal` to it as soon as `ready`.
Outcome run_lockstep_until(const std::function<bool()>& ready, int signal, const std::vector<std::string>& arguments);

/// Empty if run_lockstep_on_terminal can be called; else what is missing.
std::string why_no_terminal();

/// What is typed once `trigger` was shown, after what was typed before.
struct Typed {
    std::string trigger, text;
};

/// Runs lockstep on a terminal of its own, and types one after the other.
Outcome run_lockstep_on_terminal(const std::vector<std::string>& arguments, const std::vector<Typed>& typed,
                                 unsigned short columns = 80, const Surroundings& surroundings = {});

/// Runs lockstep on a terminal of its own, `columns` wide, and types `typed` (may be empty) once `trigger` was shown.
Outcome run_lockstep_on_terminal(const std::vector<std::string>& arguments, const std::string& trigger,
                                 const std::string& typed, unsigned short columns = 80,
                                 const Surroundings& surroundings = {});

} // namespace lockstep::test
