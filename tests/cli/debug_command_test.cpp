#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/cli_checks.hpp"
#include "tests/planted_shader.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::debug_command_test {

using test::run_lockstep;
using test::run_lockstep_on_terminal;

namespace {

struct Setting : test::SceneSetting {
    Setting() : SceneSetting("debug") {}
    [[nodiscard]] test::Outcome obey(const std::string& script, const std::vector<std::string>& options = {}) const {
        return run_lockstep(command(options), {.standard_input = script});
    }
    /// Standard output of a script that works.
    [[nodiscard]] std::string told(const std::string& script, const std::vector<std::string>& options = {}) const {
        const test::Outcome outcome = obey(script, options);
        CHECK(outcome.status == 0);
        CHECK(outcome.err.empty());
        return outcome.out;
    }
    /// The one line of error at which a script ends.
    [[nodiscard]] std::string error(const std::string& script, const std::vector<std::string>& options = {}) const {
        const test::Outcome outcome = obey(script, options);
        CHECK(outcome.status == 2);
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
        REQUIRE_THAT(outcome.err, Catch::StartsWith("lockstep: "));
        return outcome.err.substr(10, outcome.err.size() - 11);
    }
    void plant_last_found() const {
        test::plant(shaders, "collision_pass.vert", "if (u_CollisionRange > len && len < particle_min_length)",
                    "if (u_CollisionRange > len)");
    }
};

std::vector<std::string> lines(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> result;
    for (std::string line; std::getline(stream, line);)
        result.push_back(line);
    return result;
}

std::string label(const std::string& row) { return row.substr(2, row.find("  ", 2) - 2); }

} // namespace

TEST_CASE("debug_command: frame, particle and texel choose the place") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    CHECK(setting.told("frame 2\n") == "frame 2: particles: none differ; texels: none differ\n");
    CHECK_THAT(setting.told("particle 17\n"), Catch::StartsWith("particle 17 in frame 0\n  before  position ("));
    CHECK_THAT(setting.told("particle 17\nframe 3\nparticle 17\n"), Catch::Contains("\nparticle 17 in frame 3\n"));
    CHECK(setting.told("frame 2\ntexel 31,20\n") ==
          "frame 2: particles: none differ; texels: none differ\nframe 2 texel 31,20\n");
    CHECK_THAT(setting.told("frame 3\nframe 1\nparticle 5\nstep\n"),
               Catch::EndsWith(setting.told("frame 1\nparticle 5\nstep\n")));
}

TEST_CASE("debug_command: step and back walk the table that show prints") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const std::string shown = setting.told("frame 2\nparticle 17\nshow\n");
    const std::vector<std::string> walked = lines(setting.told("particle 17\nstep\nstep\nstep 3\nback\nback 2\n"));
    REQUIRE(walked.size() == 4 + 5);
    CHECK(label(walked[4]) == "clip.x");
    CHECK(label(walked[5]) == "clip.y");
    CHECK(label(walked[6]) == "clip / w.x");
    CHECK(label(walked[7]) == "clip.w");
    CHECK(label(walked[8]) == "clip.y");
    for (const std::string& row : lines(setting.told("frame 2\nparticle 17\nstep\nstep\n")))
        CHECK_THAT(shown, Catch::Contains(row));
    CHECK_THAT(setting.told("texel 31,20\nshow\n"), Catch::Contains("texel (31, 20) in frame 0\n"));
    CHECK_THAT(setting.told("step\n", {"--hex"}), Catch::Contains("0x1."));
}

TEST_CASE("debug_command: next finds fetches of this particle") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const std::vector<std::string> rows = lines(setting.told("frame 1\nnext fetch\nnext fetch\nback\n"));
    REQUIRE(rows.size() == 4);
    CHECK_THAT(rows[1], Catch::StartsWith("  texel ("));
    CHECK_THAT(rows[2], Catch::StartsWith("  texel ("));
    CHECK(rows[3] == rows[1]);
    CHECK(setting.error("step 1000\nnext fetch\n") == "line 2: frame 0 particle 0: no further fetch");
}

TEST_CASE("debug_command: next difference and next divergence go to the first of them, wherever it is") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    CHECK(setting.error("next difference\n", {"--frames", "3"}) ==
          "line 1: frame 0 particle 0: no further difference up to frame 2; --frames sets how far is looked");
    setting.plant_last_found();
    const std::string found = setting.told("next divergence\nwhy\nnext difference\nlist divergent\n");
    CHECK_THAT(found, Catch::Matches("frame \\d+ particle \\d+\n> texel \\(\\d+, \\d+\\) .*DIVERGENT\n"
                                     "particle \\d+ in frame \\d+: divergent\n  legal outcome 1 of (.|\n)*"
                                     "  texel \\(\\d+, \\d+\\): \"not taken\" follows from .*\n"
                                     "> .* (DIVERGENT|follows)\n(particle \\d+\n)+(.|\n)*"));
    const std::string check = run_lockstep({"check", setting.scene, "--frames", "8", "--gl", test::software_gl(),
                                            "--shaders", setting.shaders.path()})
                                  .out;
    const std::string place = found.substr(0, found.find('\n'));
    CHECK_THAT(check, Catch::Contains("first     " + place + ", divergent"));
}

TEST_CASE("debug_command: next nan goes to the next NaN") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    test::plant(setting.shaders, "collision_pass.vert", "v_Dir = ls_normalize(temp);",
                "v_Dir = gl_VertexID == 23 ? vec3(sqrt(-1.0)) : ls_normalize(temp);");
    const std::string found = setting.told("next nan\nnext nan\n");
    CHECK_THAT(found, Catch::Matches("frame 0 particle 23\n> direction\\.x .* -?nan .*NaN  DIVERGENT\n"
                                     "> direction\\.y .*\n"));
}

TEST_CASE("debug_command: set runs the same frame with another switch, on both sides") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const std::string script = "frame 3\nset arithmetic=exact\nset collision_range=0.2\nparticle 3\nshow\n";
    const std::string told = setting.told(script);
    CHECK_THAT(told, Catch::StartsWith("frame 3: particles: none differ; texels: none differ\n"
                                       "frame 3: particles: none differ; texels: none differ\n"
                                       "frame 3: particles: none differ; texels: none differ\n"));
    const test::Outcome explained =
        run_lockstep({"explain", setting.scene, "--gl", test::software_gl(), "--frame", "3", "--particle", "3", "--set",
                      "arithmetic=exact", "--set", "collision_range=0.2"});
    const std::string table = explained.out.substr(explained.out.find("particle 3 in frame 3"));
    CHECK_THAT(told, Catch::EndsWith(table));
}

TEST_CASE("debug_command: help names every command; quit, and the end of the input, end it") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const std::string help = setting.told("help\n");
    for (const char* command : {"frame, f F ", "particle I ", "texel X,Y ", "show ", "step, s [N] ", "back [N] ",
                                "next, n fetch|difference|divergence|nan ", "why, w ", "print, p NAME ",
                                "history [NAME] ", "break, b [NAME < NUMBER | FILE:LINE] ", "continue, c ",
                                "set NAME=VALUE ", "list, l divergent|", "source FILE ", "help, h ", "quit, q "})
        CHECK_THAT(help, Catch::Contains(command));
    CHECK(setting.told("# a comment\n\n  \nquit # the end\nnonsense\n").empty());
    CHECK(setting.told("").empty());
}

TEST_CASE("debug_command: what cannot be done is told with the line of the script, and ends it") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    CHECK(setting.error("\n# first\nnonsense\n") == "line 3: unknown command 'nonsense'; the commands are frame, "
                                                    "particle, texel, show, step, back, line, next, why, "
                                                    "print, history, break, continue, set, list, source, help, quit");
    CHECK_THAT(setting.error("fram 2\n"), Catch::EndsWith("; did you mean frame?"));
    CHECK_THAT(setting.error(std::string("fra\0me 2\n", 9)),
               Catch::StartsWith("line 1: unknown command 'fra\\x00me'; the commands are frame, "));
    CHECK(setting.error("continue\n") == "line 1: continue: there is no break; `break NAME < NUMBER` makes one");
    CHECK(setting.error("break speed near 0.1\n") ==
          "line 1: break: 'speed near 0.1' is not NAME < NUMBER; <=, >, >=, ==, != go as well");
    CHECK(setting.error("break speed < nan\n") ==
          "line 1: break: 'speed < nan' is not NAME < NUMBER; <=, >, >=, ==, != go as well");
    CHECK(setting.error("break sped < 0.1\n") == "line 1: break: frame 0 particle 0: there is no row 'sped' with a "
                                                 "number; did you mean speed?; `show` lists them");
    CHECK_THAT(setting.error("print clipp.x\n"),
               Catch::StartsWith("line 1: print: frame 0 particle 0: ") && Catch::Contains("did you mean clip.x?"));
    CHECK_THAT(setting.error("history colour\n"),
               Catch::StartsWith("line 1: history: particle has no 'colour'; it has position.x, "));
    CHECK_THAT(setting.error("set arithmetic=loose\n"), Catch::StartsWith("line 1: ") && Catch::Contains("exact"));
    const test::Outcome outcome = setting.obey("frame 1\nnonsense\nframe 2\n");
    CHECK(outcome.out == "frame 1: particles: none differ; texels: none differ\n");
}

TEST_CASE("debug_command: break and continue go on to the frame where a row of the item is so") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const std::string told = setting.told("particle 17\nbreak position.y < 0.1\nb position.y>0.2\nbreak\n");
    CHECK_THAT(told, Catch::EndsWith("break where position.y < 0.1\nbreak where position.y > 0.2\n"
                                     "position.y < 0.1\nposition.y > 0.2\n"));
    const std::string first = setting.told("particle 17\nhistory position.y\n");
    const auto y = std::stof(first.substr(first.rfind("position.y ") + 11));
    // It moves for eight frames; what it passes on the way is found, whichever way that is.
    const std::string after = setting.told("particle 17\nframe 7\nhistory position.y\n");
    const auto end = std::stof(after.substr(after.rfind("position.y ") + 11));
    REQUIRE(y != end);
    const std::string condition =
        "break position.y " + std::string(end > y ? "> " : "< ") + std::to_string((y + end) / 2);
    const std::string found = setting.told("particle 17\n" + condition + "\nc\nprint position.y\n");
    CHECK_THAT(found, Catch::Matches("(.|\n)*frame [1-7] particle 17\nposition.y [<>] [-0-9.]+ holds: (.|\n)*"));
    CHECK_THAT(setting.error("break speed == 77\ncontinue\n", {"--frames", "4"}),
               Catch::StartsWith("line 2: frame 0 particle 0: no further break up to frame 3; --frames"));
}

TEST_CASE("debug_command: history has a line for each frame, and both sides where they differ") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    CHECK(lines(setting.told("frame 3\nparticle 5\nhistory\n")).size() >= 5);
    const std::string told = setting.told("frame 3\nparticle 5\nhistory speed\nprint position\n");
    CHECK_THAT(told, Catch::Contains("particle 5: the GPU's values, and the reference's where they differ\n"
                                     "     0  speed ") &&
                         Catch::Contains("\n     3  speed ") && !Catch::Contains("\n     4  speed "));
    CHECK_THAT(told, Catch::Contains("  position.x ") && Catch::Contains("  position.z "));
    test::plant(setting.shaders, "collision_pass.vert", "v_Dir = ls_normalize(temp);", "v_Dir = -ls_normalize(temp);");
    CHECK_THAT(setting.told("history direction.y\n"), Catch::Contains("(reference "));
}

TEST_CASE("debug_command: a recording is walked through without GL, as far as it goes") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    setting.plant_last_found();
    const std::string file = (setting.folder.path() / "run.h5").string();
    REQUIRE(run_lockstep({"record", setting.scene, "--frames", "8", "--gl", test::software_gl(), "--shaders",
                          setting.shaders.path(), "-o", file})
                .status == 0);
    const auto obey = [&](const std::string& script) {
        return run_lockstep({"debug", "--trace", file}, {.standard_input = script});
    };
    const test::Outcome found = obey("next divergence\nframe 7\n");
    CHECK(found.status == 0);
    CHECK_THAT(found.out, Catch::Matches("frame \\d+ particle \\d+\n> (.|\n)*DIVERGENT(.|\n)*frame 7: (.|\n)*"));
    CHECK_THAT(obey("frame 8\n").err, Catch::Contains("line 1: frame 8: the recording holds frames 0 to 7"));
    CHECK_THAT(obey("set tick=1\n").err, Catch::Contains("line 1: set: what was recorded stays what it is"));
    CHECK(refusal(run_lockstep({"debug", setting.scene, "--trace", file})).find("--trace") != std::string::npos);
}

TEST_CASE("debug_command: of another system's scene passes and items are walked through") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder folder, shaders;
    const std::string scene = "data/scenes/dust/physics.json";
    const auto obey = [&](const std::string& script, std::vector<std::string> options = {}) {
        return run_lockstep(test::joined({"debug", scene, "--particles", "200", "--gl", test::software_gl()},
                                         test::joined(test::shader_options(shaders), std::move(options))),
                            {.standard_input = script});
    };
    const test::Outcome right = obey("frame 4\npass update\nitem 17\nshow\nhistory position\nwhy\n");
    CHECK(right.err.empty());
    CHECK_THAT(right.out, Catch::Contains("frame 4: ") && Catch::Contains("update: none differ") &&
                              Catch::Contains("\nframe 4 update, grain 17\ngrain 17 in frame 4, pass update\n") &&
                              Catch::Contains("\n     4  position.x ") &&
                              Catch::Contains("update, grain 17 in frame 4\nverdict   every bit agrees\n"));
    const test::Outcome explained = run_lockstep({"explain", scene, "--particles", "200", "--gl", test::software_gl(),
                                                  "--frame", "4", "--pass", "update", "--item", "17"});
    CHECK_THAT(right.out, Catch::Contains(explained.out.substr(explained.out.find("grain 17 in frame"))));
    CHECK_THAT(obey("frame 2\nset tick=0.01\n").err + obey("frame 2\nset preset=exact\n").err,
               Catch::Contains("line 2: "));
    CHECK_THAT(obey("pass updat\n").err,
               Catch::Contains("there is no pass 'updat'; there are ") && Catch::Contains("did you mean update?"));
    CHECK_THAT(obey("item 200\n").err, Catch::Contains("there is no grain '200'; "));

    std::ifstream shipped("shaders/dust/update.comp");
    std::string text((std::istreambuf_iterator<char>(shipped)), {});
    const std::string gravity = "add(a, gravity)";
    const std::size_t use = text.find(gravity);
    REQUIRE(use != std::string::npos);
    text.replace(use, gravity.size(), "add(a, 2.0 * gravity)");
    shaders.write("update.comp", text);
    const test::Outcome wrong = obey("next divergence\nwhy\nlist divergent\n");
    CHECK_THAT(wrong.out, Catch::StartsWith("frame 0 update, grain ") && Catch::Contains("DIVERGENT") &&
                              Catch::Contains("verdict   divergent") && Catch::Contains("and 180 more"));
}

TEST_CASE("debug_command: on a terminal there is a prompt, and an error does not end it") {
    if (!test::have_software_gl() || !test::have_terminal())
        return;
    const Setting setting;
    const std::string shown =
        run_lockstep_on_terminal(setting.command(), "(lockstep) ", "nonsense\nframe 1\nquit\n").out;
    CHECK_THAT(shown, Catch::Contains("unknown command 'nonsense'; the commands are frame,") &&
                          Catch::Contains("frame 1: particles: none differ"));
}

TEST_CASE("debug_command: on a terminal it opens with scene, driver, place and what to type") {
    if (!test::have_software_gl() || !test::have_terminal())
        return;
    const Setting setting;
    const auto opening = [](const std::vector<std::string>& command) {
        const std::string shown = run_lockstep_on_terminal(command, "(lockstep) ", "quit\n").out;
        return shown.substr(0, shown.find("(lockstep) "));
    };
    CHECK_THAT(opening(setting.command()),
               Catch::StartsWith("scene     scene (") && Catch::Contains("scene.json)\r\nswitches  ") &&
                   Catch::Contains("\nGL        llvmpipe") &&
                   Catch::Contains("\nat        frame 0 particle 0\r\ntype      `next divergence` ") &&
                   Catch::Contains("`particle I`, `texel X,Y`, ") && Catch::Contains("`help` for all commands"));
    CHECK_THAT(opening({"debug", "data/scenes/dust/physics.json", "--particles", "50", "--gl", test::software_gl()}),
               Catch::Contains("scene     ") && Catch::Contains("(data/scenes/dust/physics.json)") &&
                   Catch::Contains("\nGL        llvmpipe") && Catch::Contains("\nat        frame 0 ") &&
                   Catch::Contains(", grain 0\r\n") && Catch::Contains("`pass NAME`, `item I|X,Y`, "));
}

TEST_CASE("debug_command: source obeys a file of commands, to its first error") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const std::string inner = setting.folder.write("inner.txt", "particle 17\n# a comment\nstep\n").string();
    const std::string outer =
        setting.folder.write("outer.txt", "frame 2\r\nsource " + inner + "\nback 3\nstep\n").string();
    CHECK(setting.told("frame 2\nparticle 17\nstep\n") == setting.told("frame 2\nsource " + inner + "\n"));
    const test::Outcome wrong = setting.obey("# first\nsource " + outer + "\nframe 1\n");
    CHECK(wrong.status == 2);
    CHECK(wrong.out == setting.told("frame 2\nsource " + inner + "\n"));
    CHECK_THAT(wrong.err, Catch::StartsWith("lockstep: line 2: " + outer + ":3: frame 2 particle 17: "));
    CHECK(setting.told("source " + setting.folder.write("end.txt", "quit\nnonsense\n").string() + "\nnonsense\n")
              .empty());
    CHECK(setting.error("source\n") == "line 1: source: the name of a file of commands is missing");
    CHECK_THAT(setting.error("source nowhere.txt\n"), Catch::StartsWith("line 1: ") && Catch::Contains("nowhere.txt"));
    CHECK_THAT(setting.error("source " + setting.folder.path().string() + "\n"), Catch::Contains("file of commands"));
    const std::string again = (setting.folder.path() / "again.txt").string();
    static_cast<void>(setting.folder.write("again.txt", "source " + again + "\n"));
    CHECK_THAT(setting.error("source " + again + "\n"), Catch::EndsWith("more than 16 files, one within the other"));
}

TEST_CASE("debug_command: Ctrl-C stops every command that takes long, and the session goes on where it came to") {
    if (!test::have_software_gl() || !test::have_terminal())
        return;
    const std::string prompt = "(lockstep) ", ctrl_c = "\x03";
    // What is typed, and stopped.
    const auto stopped = [&](const std::vector<std::string>& command, const std::vector<std::string>& lines) {
        std::vector<test::Typed> typed;
        for (const std::string& line : lines) {
            if (line == "continue")
                typed.push_back({prompt, "break speed < -1\n"});
            typed.push_back({prompt, line + "\n"});
            typed.push_back({line + "\r\n", ctrl_c});
            typed.push_back({"stopped", ""});
        }
        typed.push_back({prompt, "frame 1\nquit\n"});
        const test::Outcome outcome = run_lockstep_on_terminal(command, typed);
        CHECK(outcome.status == 0);
        CHECK_THAT(outcome.out, Catch::Contains("\nframe 1: ") && !Catch::Contains("silent for too long"));
        return outcome.out;
    };
    SECTION("of the collision system") {
        const Setting setting;
        const std::string shown = stopped(setting.command({"--frames", "100000000"}),
                                          {"frame 90000000", "next divergence", "next nan", "continue"});
        CHECK_THAT(shown, Catch::Contains("stopped in frame ") && Catch::Contains("; no further break up to there"));
    }
    SECTION("of another system") {
        stopped({"debug", "data/scenes/dust/physics.json", "--particles", "50", "--frames", "100000000", "--gl",
                 test::software_gl()},
                {"frame 90000000", "next difference", "next nan"});
    }
    SECTION("in a file of commands") {
        const Setting setting;
        const std::string file = setting.folder.write("far.txt", "frame 1\nframe 90000000\nnonsense\n").string();
        CHECK_THAT(stopped(setting.command(), {"source " + file}),
                   Catch::Contains(": stopped in frame ") && !Catch::Contains("unknown command"));
    }
}

TEST_CASE("debug_command: at the prompt Tab completes, arrows repeat, Ctrl-C stops a command and not the session") {
    if (!test::have_software_gl() || !test::have_terminal())
        return;
    const Setting setting;
    const std::string prompt = "(lockstep) ", up = "\x1b[A", ctrl_c = "\x03";
    const std::string shown =
        run_lockstep_on_terminal(setting.command({"--frames", "100000"}), {{prompt, "fra\t2\n"},
                                                                           {"frame 2: particles", ""},
                                                                           {prompt, up + "\n"},
                                                                           {"frame 2: particles", ""},
                                                                           {prompt, "half a li" + ctrl_c},
                                                                           {prompt, "next na\t\n"},
                                                                           {"next na", ""},
                                                                           {"n \r\n", ctrl_c},
                                                                           {"stopped in frame ", ""},
                                                                           {prompt, "frame 1\nquit\n"}})
            .out;
    CHECK_THAT(shown, Catch::Contains("stopped in frame "));
    CHECK_THAT(shown, Catch::Contains("frame 1: particles: none differ"));
    CHECK_THAT(shown, !Catch::Contains("unknown command"));
}

} // namespace lockstep::test::debug_command_test
