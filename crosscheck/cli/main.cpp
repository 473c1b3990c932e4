#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/option_values.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/signals.hpp"
#include "crosscheck/files/standard_output.hpp"
#include "crosscheck/files/threads.hpp"
#include "gpu/shaders_read_once.hpp"
#include "reference/model/error.hpp"

namespace {

std::string verbs(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* verb : app.get_subcommands({}))
        names.push_back(verb->get_name());
    return fmt::format("{}", fmt::join(names, ", "));
}

/// The library's own words are for programmers.
std::string usage_error(const CLI::App& app, const CLI::Error& error) {
    const bool verb_given = !app.get_subcommands().empty();
    std::vector<std::string> unknown = app.remaining(true);
    std::stable_partition(unknown.begin(), unknown.end(), [](const std::string& text) { return text[0] == '-'; });
    if (!verb_given && unknown.empty())
        return fmt::format("a verb is missing; the verbs are {}", verbs(app));
    if (!unknown.empty() && unknown.front().starts_with('-'))
        return fmt::format("unknown option '{}'", unknown.front());
    if (!verb_given)
        return fmt::format("unknown verb '{}'; the verbs are {}", unknown.front(), verbs(app));
    if (!unknown.empty())
        return fmt::format("'{}' is one argument too many", unknown.front());
    const std::string text = error.what();
    if (error.get_name() == "ArgumentMismatch") {
        const std::string option = text.substr(0, text.find(':'));
        const bool twice = text.find("received") != std::string::npos;
        return fmt::format("{} {}", option, twice ? "is given more than once" : "needs a value");
    }
    return text;
}

int run(int argc, char** argv) {
    using namespace lockstep;
    CLI::App app("lockstep: runs an image-based particle system as plain C++ and as GLSL on OpenGL, and compares every "
                 "bit of every frame");
    app.name("lockstep");
    app.require_subcommand(1);
    app.failure_message([](const CLI::App* root, const CLI::Error& error) {
        return fmt::format("lockstep: {} (lockstep --help tells more)\n", plain_line(usage_error(*root, error)));
    });
    const ShadersReadOnce one_text_a_run;
    int status = status_could_not_run;
    add_check_command(app, status);
    add_explain_command(app, status);
    add_debug_command(app, status);
    add_render_command(app, status);
    add_hash_command(app, status);
    add_info_command(app, status);
    add_probe_command(app, status);
    add_bench_command(app, status);
    add_study_command(app, status);
    add_record_command(app, status);
    add_trace_command(app, status);
    add_capsule_command(app, status);
    add_report_command(app, status);
    add_completion_command(app, status);
    add_manual_command(app, status);
    refuse_empty_names(app);
    app.footer("lockstep VERB --help tells more of each.\n"
               "Example: lockstep check data/scenes/lattice.json --frames 100");
    try {
        try {
            app.parse(argc, argv);
        } catch (const CLI::ParseError& error) {
            std::ostringstream out, err;
            status = app.exit(error, out, err) == 0 ? 0 : status_could_not_run;
            fmt::print("{}", out.str());
            fmt::print(stderr, "{}", err.str());
        }
        finish_standard_output();
    } catch (const std::bad_alloc&) {
        std::fputs("lockstep: not enough memory; fewer particles (--particles) or a smaller image need less\n", stderr);
        return status_could_not_run;
    } catch (const std::filesystem::filesystem_error& error) {
        std::fprintf(stderr, "lockstep: %s: %s\n", plain_line(error.path1().string()).c_str(),
                     error.code().message().c_str());
        return status_could_not_run;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "lockstep: %s\n", plain_line(error.what()).c_str());
        return status_could_not_run;
    }
    return status;
}

} // namespace

int main(int argc, char** argv) {
    using namespace lockstep;
    let_waiting_threads_sleep(argv);
    own_signals(status_could_not_run);
    own_standard_output();
    const int status = run(argc, argv);
    leave_main();
    return status;
}
