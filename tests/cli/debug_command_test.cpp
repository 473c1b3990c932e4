#include <catch2/catch.hpp>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/cli_checks.hpp"
#include "tests/planted_shader.hpp"
#include "tests/temporary_folder.hpp"

using namespace lockstep;
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
    for (const char* command :
         {"frame F ", "particle I ", "texel X,Y ", "show ", "step [N] ", "back [N] ",
          "next fetch|difference|divergence|nan ", "why ", "set NAME=VALUE ", "list divergent|", "help ", "quit "})
        CHECK_THAT(help, Catch::Contains(command));
    CHECK(setting.told("# a comment\n\n  \nquit # the end\nnonsense\n").empty());
    CHECK(setting.told("").empty());
}

TEST_CASE("debug_command: what cannot be done is told with the line of the script, and ends it") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    CHECK(setting.error("\n# first\nnonsense\n") == "line 3: unknown command 'nonsense'; the commands are frame, "
                                                    "particle, texel, show, step, back, next, why, set, "
                                                    "list, help, quit");
    CHECK_THAT(setting.error("set arithmetic=loose\n"), Catch::StartsWith("line 1: ") && Catch::Contains("exact"));
    const test::Outcome outcome = setting.obey("frame 1\nnonsense\nframe 2\n");
    CHECK(outcome.out == "frame 1: particles: none differ; texels: none differ\n");
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
