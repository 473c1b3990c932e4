#include <catch2/catch.hpp>

#include <array>
#include <fstream>
#include <iterator>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/cli/cli_checks.hpp"
#include "tests/planted_shader.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::terminal_test {

using test::run_lockstep;
using test::run_lockstep_on_terminal;

namespace {

const std::string ctrl_c = "\x03";
const std::string bar = "check [";

} // namespace

TEST_CASE("terminal: a bar on a terminal, wiped at the end; none in a pipe, none when quiet") {
    if (!test::have_software_gl() || !test::have_terminal())
        return;
    const test::TemporaryFolder folder;
    const std::vector<std::string> check{
        "check", folder.write("scene.json", test::small_scene).string(), "--frames", "5", "--gl", test::software_gl()};
    std::vector<std::string> quiet = check;
    quiet.emplace_back("--quiet");

    CHECK_THAT(run_lockstep_on_terminal(check, "", "").out, Catch::Contains(bar) && Catch::Contains("/5 ") &&
                                                                Catch::Contains("\r\x1b[Kscene ") &&
                                                                Catch::Contains("AGREE"));
    CHECK(run_lockstep_on_terminal(quiet, "", "").out.empty());
    const test::Outcome piped = run_lockstep(check);
    CHECK(piped.err.empty());
    CHECK_THAT(piped.out, !Catch::Contains(bar) && !Catch::Contains("\x1b"));
}

TEST_CASE("terminal: the verdict is in colour, unless NO_COLOR is set or the terminal has none") {
    if (!test::have_software_gl() || !test::have_terminal())
        return;
    const test::TemporaryFolder folder;
    const auto shown = [&](const std::vector<std::pair<std::string, std::string>>& environment) {
        test::Surroundings surroundings;
        surroundings.environment = environment;
        return run_lockstep_on_terminal({"check", folder.write("scene.json", test::small_scene).string(), "--frames",
                                         "2", "--gl", test::software_gl()},
                                        "", "", 80, surroundings)
            .out;
    };
    const std::string green = "verdict   \x1b[32mAGREE\x1b[0m", plain = "verdict   AGREE";
    CHECK_THAT(shown({{"TERM", "xterm"}, {"NO_COLOR", ""}}), Catch::Contains(green));
    CHECK_THAT(shown({{"TERM", "xterm"}, {"NO_COLOR", "1"}}), Catch::Contains(plain));
    CHECK_THAT(shown({{"TERM", "dumb"}, {"NO_COLOR", ""}}), Catch::Contains(plain));
}

TEST_CASE("terminal: the bar keeps to one line, however narrow") {
    if (!test::have_software_gl() || !test::have_terminal())
        return;
    const test::TemporaryFolder folder;
    for (const unsigned short columns : std::array<unsigned short, 4>{120, 30, 12, 2}) {
        CAPTURE(columns);
        const std::string shown =
            run_lockstep_on_terminal({"check", folder.write("scene.json", test::small_scene).string(), "--frames", "20",
                                      "--gl", test::software_gl()},
                                     "", "", columns)
                .out;
        const std::string wipe = "\r\x1b[K";
        std::size_t bars = 0;
        for (std::size_t at = shown.find(wipe); at != std::string::npos; ++bars) {
            at += wipe.size();
            const std::size_t next = shown.find(wipe, at);
            if (next != std::string::npos)
                CHECK(next - at < columns);
            at = next;
        }
        CHECK(bars > 1);
    }
}

TEST_CASE("terminal: Ctrl-C ends with a verdict on the frames done so far, marked as partial, and status 130") {
    if (!test::have_software_gl() || !test::have_terminal())
        return;
    const test::TemporaryFolder folder;
    const test::TemporaryFolder shaders;
    std::vector<std::string> check{"check",    folder.write("scene.json", test::small_scene).string(),
                                   "--frames", "100000000",
                                   "--gl",     test::software_gl(),
                                   "--json",   folder.path() / "report.json"};
    const auto report = [&] { return nlohmann::json::parse(std::ifstream(folder.path() / "report.json")); };
    SECTION("agreed so far") {
        const test::Outcome outcome = run_lockstep_on_terminal(check, bar, ctrl_c);
        CHECK(outcome.status == 130);
        CHECK_THAT(
            outcome.out,
            Catch::Matches("(.|\r|\n)*AGREE\033\\[0m \\(partial: stopped after \\d+ of 100000000 frames\\)(, but "
                           "nothing collided)?: every bit of (.|\r|\n)*"));
        CHECK(report()["partial"] == true);
        CHECK(report()["frames_asked"] == 100000000);
    }
    SECTION("differed so far") {
        test::plant(shaders, "collision_pass.vert", "ls_flush(a_CollideTime) - u_Tick;", "ls_flush(a_CollideTime);");
        check.insert(check.end(), {"--shaders", shaders.path()});
        const test::Outcome outcome = run_lockstep_on_terminal(check, bar, ctrl_c);
        CHECK(outcome.status == 130);
        CHECK_THAT(outcome.out, Catch::Contains("DIVERGENT\033[0m (partial: stopped after ") &&
                                    Catch::Contains("frames) from frame 0 on"));
        CHECK(report()["partial"] == true);
    }
    SECTION("into a pipe or a file") {
        const std::string output = folder.write("output.txt", "");
        const test::Outcome outcome = run_lockstep_on_terminal(check, bar, ctrl_c, 80, {.standard_output = output});
        CHECK(outcome.status == 130);
        std::ifstream stream(output);
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        CHECK_THAT(text, Catch::Contains("verdict   AGREE (partial: stopped after "));
        std::filesystem::remove(output);
    }
    CHECK(test::names_in(folder.path()) == std::vector<std::string>{"report.json", "scene.json"});
}

} // namespace lockstep::test::terminal_test
