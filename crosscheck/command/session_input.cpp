#include "crosscheck/command/session_input.hpp"

#include <cstdio>
#include <iostream>
#include <optional>

#include <fmt/format.h>
#include <unistd.h>

#include "crosscheck/command/line_editor.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/report/colour.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// An error's text would end at a character 0.
std::string obeyed(const Session& session, const std::string& line) {
    return colored(plain_text(session.obey(line.find('\0') == line.npos ? line : plain_line(line))));
}

void obey_terminal(const Session& session) {
    LineEditor editor("(lockstep) ", session.complete);
    while (!session.ended()) {
        const std::optional<std::string> line = editor.line();
        if (!line)
            return;
        try {
            fmt::print("{}", obeyed(session, *line));
        } catch (const Error& error) {
            fmt::print("{}\n", plain_line(error.what()));
        }
        std::fflush(stdout);
    }
}

} // namespace

void obey_input(const Session& session) {
    if (isatty(STDIN_FILENO) == 1 && isatty(STDOUT_FILENO) == 1)
        return obey_terminal(session);
    std::string line;
    for (int number = 1; !session.ended() && std::getline(std::cin, line); ++number) {
        try {
            fmt::print("{}", obeyed(session, line));
            std::fflush(stdout);
        } catch (const Error& error) {
            throw Error(fmt::format("line {}: {}", number, error.what()));
        }
    }
}

} // namespace lockstep
