#pragma once
#include <functional>
#include <string>
#include <vector>

namespace lockstep {

/// What obeys lines, one after the other.
struct Session {
    std::string opening;                                      ///< whole lines, shown at a terminal first
    std::function<std::string(const std::string& line)> obey; ///< gives whole lines to print; throws Error
    std::function<bool()> ended;
    std::function<std::vector<std::string>(const std::string& line)> complete; ///< at a terminal
};

/// Prints whole lines, with colours at a terminal and nothing that would steer it.
void print_lines(const std::string& lines);

/// Hands standard input to it line by line. At a terminal there is a prompt with editing, an error is reported and the
/// session goes on, and Ctrl-C stops a command (`interrupted`, signals.hpp) and not the session. A script ends at its
/// first Error, which names the line.
void obey_input(const Session& session);

} // namespace lockstep
