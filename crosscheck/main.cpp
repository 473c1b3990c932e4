#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>

#include "crosscheck/commands/commands.hpp"

int main(int argc, char** argv) {
    using namespace lockstep;
    CLI::App app("lockstep: runs an image-based particle system as plain C++ and as GLSL on OpenGL, and compares every "
                 "bit of every frame");
    app.name("lockstep");
    app.require_subcommand(1);
    app.failure_message([](const CLI::App*, const CLI::Error& error) {
        return "lockstep: " + std::string(error.what()) + " (lockstep --help tells more)\n";
    });
    int status = status_could_not_run;
    add_check_command(app, status);
    add_render_command(app, status);
    add_hash_command(app, status);
    add_info_command(app, status);
    add_probe_command(app, status);
    add_bench_command(app, status);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : status_could_not_run;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "lockstep: %s\n", error.what());
        return status_could_not_run;
    }
    return status;
}
