#include <cstdio>
#include <iostream>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <unistd.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/collision/report/debug_session.hpp"
#include "crosscheck/command/judging_options.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "gpu/context.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

struct DebugRequest {
    RunOptions run;
    Legal legal = Legal::measured;
    bool hexadecimal = false;
};

/// Obeys standard input line by line. On a terminal an error is told and the session goes on; a script ends at its
/// first error, which names the line.
void obey_input(DebugSession& session) {
    const bool terminal = isatty(STDIN_FILENO) == 1;
    std::string line;
    for (int number = 1; !session.ended(); ++number) {
        if (terminal) {
            fmt::print("(lockstep) ");
            std::fflush(stdout);
        }
        if (!std::getline(std::cin, line)) {
            if (terminal)
                fmt::print("\n");
            return;
        }
        try {
            fmt::print("{}", plain_text(session.obey(line)));
            std::fflush(stdout);
        } catch (const Error& error) {
            if (!terminal)
                throw Error(fmt::format("line {}: {}", number, error.what()));
            fmt::print("{}\n", plain_line(error.what()));
        }
    }
}

int run(const DebugRequest& options) {
    const auto load_with = [&](const std::vector<std::string>& changes) {
        RunOptions changed = options.run;
        changed.set.insert(changed.set.end(), changes.begin(), changes.end());
        return load(changed);
    };
    static_cast<void>(shaders_to_run(options.run, load_with({})));
    const Context context(parse_context_request(options.run.gl));
    const Profile profile = measured_profile(context, options.run.shaders);
    DebugSession session({.load = load_with,
                          .start =
                              [&](Scene scene) {
                                  return std::make_unique<FrameRun>(std::move(scene), profile,
                                                                    known_operations(options.legal, profile),
                                                                    options.run.shaders);
                              },
                          .frames = options.run.frames,
                          .format = options.hexadecimal ? NumberFormat::hexadecimal : NumberFormat::decimal});
    obey_input(session);
    return status_agree;
}

} // namespace

Verb debug_command() {
    auto options = std::make_shared<DebugRequest>();
    Verb verb{"debug", "walk through both sides by commands, typed or from a pipe"};
    add_scene_options(verb, options->run);
    add_gl_options(verb, options->run);
    verb.add(
        integer_option("--frames", "N", {1, most_frames}, options->run.frames, "how many frames `next` looks through"));
    add_legal_option(verb, options->legal);
    verb.add(flag("--hex", options->hexadecimal, "hexadecimal floats instead of decimal ones"));
    verb.footer = "Commands: frame, particle, texel, show, step, back, next fetch|difference|divergence|nan, why, "
                  "set NAME=VALUE, list divergent, help, quit; # starts a comment.\n"
                  "Exit status: 0 told, 2 could not run, or a command of a script could not be done.\n"
                  "Example: printf 'next difference\\nwhy\\n' | lockstep debug data/scenes/lattice.json --shaders mine";
    verb.run = [options](const Call&) { return run(*options); };
    return verb;
}

} // namespace lockstep
