#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/command/command_line.hpp"
#include "crosscheck/files/heap.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/signals.hpp"
#include "crosscheck/files/standard_output.hpp"
#include "crosscheck/files/threads.hpp"
#include "gpu/shaders_read_once.hpp"
#include "reference/model/error.hpp"

namespace {

lockstep::Verb program() {
    using namespace lockstep;
    Verb program{"lockstep", "lockstep: runs an image-based particle system as plain C++ and as GLSL on OpenGL, and "
                             "compares every bit of every frame"};
    program.verbs = {check_command(),    explain_command(), debug_command(),   render_command(),     hash_command(),
                     info_command(),     probe_command(),   bench_command(),   study_command(),      record_command(),
                     trace_command(),    merge_command(),   capsule_command(), report_command(),     graph_command(),
                     function_command(), examine_command(), new_command(),     completion_command(), manual_command()};
    program.version = LOCKSTEP_VERSION;
    program.footer = "lockstep VERB --help says more of each.\n"
                     "Example: lockstep check data/scenes/lattice.json --frames 100";
    return program;
}

int run(int argc, char** argv) {
    using namespace lockstep;
    const ShadersReadOnce one_text_a_run;
    try {
        const int status = run_command_line(program(), argc, argv, status_could_not_run);
        finish_standard_output();
        return status;
    } catch (const std::bad_alloc&) {
        std::fputs("lockstep: not enough memory; fewer particles (--particles) or a smaller image need less\n", stderr);
        return status_could_not_run;
    } catch (const std::filesystem::filesystem_error& error) {
        std::fprintf(stderr, "lockstep: %s: %s\n", plain_line(error.path1().string()).c_str(),
                     error.code().message().c_str());
        return status_could_not_run;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "lockstep: %s\n", short_line(error.what()).c_str());
        return status_could_not_run;
    }
}

} // namespace

int main(int argc, char** argv) {
    using namespace lockstep;
    if (const std::string problem = stack_problem(); !problem.empty()) {
        std::fprintf(stderr, "lockstep: %s\n", problem.c_str());
        return status_could_not_run;
    }
    let_waiting_threads_sleep(argv);
    give_back_large_arrays();
    own_signals(status_could_not_run);
    own_standard_output();
    const int status = run(argc, argv);
    leave_main();
    return status;
}
