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

void obey_terminal(const Session& session) {
    print_lines(session.opening);
    LineEditor editor("(lockstep) ", session.complete);
    while (!session.ended()) {
        const std::optional<std::string> line = editor.line();
        if (!line)
            return;
        try {
            print_lines(session.obey(*line));
        } catch (const Error& error) {
            print_lines(fmt::format("{}\n", plain_line(error.what())));
        }
    }
}

} // namespace

void print_lines(const std::string& lines) {
    fmt::print("{}", colored(plain_text(lines)));
    std::fflush(stdout);
}

void obey_input(const Session& session) {
    if (isatty(STDIN_FILENO) == 1 && isatty(STDOUT_FILENO) == 1)
        return obey_terminal(session);
    std::string line;
    for (int number = 1; !session.ended() && std::getline(std::cin, line); ++number) {
        try {
            print_lines(session.obey(line));
        } catch (const Error& error) {
            throw Error(fmt::format("line {}: {}", number, error.what()));
        }
    }
}

} // namespace lockstep
