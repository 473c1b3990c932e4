#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <unistd.h>

#include <fmt/format.h>

#include "tests/cli/cli_checks.hpp"
#include "tests/skip.hpp"

namespace lockstep::test::driver_limits_test {

using Catch::Contains;
using test::run_lockstep;

/// Drivers crash and hang where they do not get what they want. The program then ends with one line and status 2, or
/// runs.
namespace {

test::Outcome check(const std::string& gl, const test::Surroundings& surroundings) {
    return run_lockstep({"check", "data/scenes/x_streams.json", "--particles", "100", "--frames", "1", "--no-render",
                         "--quiet", "--gl", gl},
                        surroundings);
}

/// The last line of what it says on standard error; drivers print lines of their own before it.
std::string last_line(const test::Outcome& outcome) {
    const std::string text = outcome.err.substr(0, outcome.err.find_last_not_of('\n') + 1);
    return text.substr(text.find_last_of('\n') + 1);
}

/// It ran, or said why not, in a line that has `reason`.
void check_ran_or_said(const test::Outcome& outcome, const std::string& reason) {
    CAPTURE(outcome.status, outcome.signal, outcome.err);
    CHECK(outcome.signal == 0);
    CHECK((outcome.status == 0 || outcome.status == 2));
    if (outcome.status == 2)
        CHECK_THAT(last_line(outcome), Catch::StartsWith("lockstep: ") && Contains(reason));
}

/// The folder on the way to a file that none but its owner comes past; empty: there is none.
std::string closed_to_others(const std::filesystem::path& file) {
    for (std::filesystem::path folder = file.parent_path();; folder = folder.parent_path()) {
        const auto mode = std::filesystem::status(folder).permissions();
        if ((mode & std::filesystem::perms::others_exec) == std::filesystem::perms::none)
            return folder.string();
        if (folder == folder.parent_path())
            return {};
    }
}

} // namespace

TEST_CASE(
    "driver limits: a driver that the library does not have is refused in one line, or another context is taken") {
    if (!test::have_software_gl())
        return;
    for (const char* driver : {"d3d12", "nonsense"}) {
        CAPTURE(driver);
        const test::Surroundings chosen{.environment = {{"GALLIUM_DRIVER", driver}}};
        if (test::has_osmesa_library()) {
            const test::Outcome outcome = check("osmesa", chosen);
            CHECK(outcome.status == 2);
            CHECK_THAT(test::refusal(outcome),
                       Catch::StartsWith("no GL context: osmesa: ") &&
                           Catch::EndsWith(fmt::format("may be why: GALLIUM_DRIVER is {}", driver)));
        }
        check_ran_or_said(check("egl", chosen), "no GL context: egl: ");
        check_ran_or_said(check("auto", chosen), "no GL context: ");
    }
    for (const auto& [name, value] : {std::pair{"MESA_LOADER_DRIVER_OVERRIDE", "nonsense"},
                                      {"EGL_PLATFORM", "nonsense"},
                                      {"LIBGL_DRIVERS_PATH", "/proc/nowhere"}}) {
        CAPTURE(name);
        check_ran_or_said(check("egl", {.environment = {{name, value}}}), "no GL context: egl: ");
    }
}

TEST_CASE("driver limits: where no threads can be started llvmpipe does without") {
    if (!test::have_software_gl())
        return;
    // Root has no such limit, so another user takes its place.
    if (const std::string closed = closed_to_others(LOCKSTEP_PROGRAM); getuid() == 0 && !closed.empty())
        return test::skip("no other user than root comes past " + closed, "LOCKSTEP_REQUIRE_OTHER_USERS");
    for (const std::size_t processes : {1U, 2U, 3U, 4U}) {
        CAPTURE(processes);
        check_ran_or_said(check(test::software_gl(), {.processes = processes}), "threads");
    }
}

#ifndef __SANITIZE_ADDRESS__ // which needs more address space than there is memory
TEST_CASE("driver limits: a limit of memory is named, and nothing crashes or hangs in the driver") {
    if (!test::have_software_gl())
        return;
    for (const std::size_t mebibytes : {100U, 200U, 290U, 390U, 490U, 730U}) {
        CAPTURE(mebibytes);
        check_ran_or_said(check(test::software_gl(), {.memory = mebibytes << 20U}), "(ulimit -v)");
    }
}
#endif

TEST_CASE("driver limits: few open files, a small stack, closed streams and no temporary folder") {
    if (!test::have_software_gl())
        return;
    for (const std::size_t files : {8U, 12U, 20U}) {
        CAPTURE(files);
        check_ran_or_said(check(test::software_gl(), {.files = files}), "");
    }
    check_ran_or_said(check(test::software_gl(), {.stack = std::size_t{300} << 10U}), "(ulimit -s)");
    check_ran_or_said(
        check(test::software_gl(), {.environment = {{"TMPDIR", "/proc/nowhere"}, {"HOME", "/proc/nowhere"}}}), "");
    const test::Outcome closed = check(test::software_gl(), {.closed = {0, 1, 2}});
    CHECK(closed.signal == 0);
    CHECK(check(test::software_gl(), {.closed = {0}}).status == 0);
}

} // namespace lockstep::test::driver_limits_test
