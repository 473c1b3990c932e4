#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/cli/cli_checks.hpp"
#include "tests/planted_shader.hpp"

namespace lockstep::test::shader_lines_test {

using Catch::Contains;
using test::plant;
using test::refusal;
using test::run_lockstep;

namespace {

const std::string declared = "    bool particle_collision = false;\n";

std::string content(const std::string& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// The line that a text is in, from 1.
std::size_t line_of(const std::string& text, const std::string& what) {
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    return 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<long>(at), '\n'));
}

} // namespace

TEST_CASE("shader lines: a #line does not move an error from its line in the file, and takes no file name") {
    if (!test::have_software_gl())
        return;
    for (const std::string line : {"#line 1000 7", "#line 100 7", "# line 3"}) {
        const test::SceneSetting setting("check");
        plant(setting.shaders, "collision_pass.vert", "#version 330 core\n", "#version 330 core\n" + line + "\n");
        plant(setting.shaders, "collision_pass.vert", declared, "    bool particle_collision = undefined_thing;\n");
        const std::string file = (setting.shaders.path() / "collision_pass.vert").string();
        CHECK_THAT(refusal(run_lockstep(setting.command({"--frames", "1"}))),
                   Catch::StartsWith("shader " + file + ":" +
                                     std::to_string(line_of(content(file), "undefined_thing")) + ": "));
    }
    const test::SceneSetting setting("check");
    plant(setting.shaders, "collision_pass.vert", "#version 330 core\n",
          "#version 330 core\n#line 100 \"C:\\proj\\x.vert\"\n");
    CHECK_THAT(refusal(run_lockstep(setting.command({"--frames", "1"}))),
               Contains("collision_pass.vert:2: ") && Contains("in GLSL #line takes numbers alone, no file name"));
}

TEST_CASE("shader lines: a #line without a line is refused, one that macros make is not") {
    const test::TemporaryFolder folder;
    const auto examined = [&](const std::string& line) {
        return run_lockstep({"examine", folder
                                            .write("a.comp", "#version 430 core\nlayout(local_size_x = 1) in;\n"
                                                             "#define TEN 10\n" +
                                                                 line + "\nvoid main() {}\n")
                                            .string()});
    };
    for (const char* broken : {"#line", "#line abc", "#line 99999999999", "#line // 5"})
        CHECK_THAT(refusal(examined(broken)), Contains("a.comp:4: ") && (Contains("line takes the number of a line") ||
                                                                         Contains("'#' : "))); // glslang 15 says so
    for (const char* line : {"#line 5", "#line TEN + 1 2", "#line __LINE__ // here", "#if 0\n#line\n#endif"})
        CHECK(examined(line).status == 0);
}

TEST_CASE("shader lines: an error in the first lines of a function's file names that file") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder folder;
    const std::string table = folder.write("t.csv", "x,result\n1,2\n").string();
    const auto said = [&](const std::string& text) {
        const std::string shader = folder.write("es.glsl", text).string();
        return refusal(run_lockstep({"function", shader, "f", "--table", table, "--gl", test::software_gl()}));
    };
    CHECK_THAT(said("#version 310 es\nprecision highp float;\nfloat f(float x) { return x + 1.0; }\n"),
               Catch::StartsWith("shader es.glsl:1: GLSL ES 310"));
    CHECK_THAT(said("// Mine.\n#version 120\nfloat f(float x) { return x + 1.0; }\n"),
               Catch::StartsWith("shader es.glsl:2: "));
    CHECK_THAT(said("#version 330 core\nfloat f(float x) { return x + nothing; }\n"),
               Catch::StartsWith("shader es.glsl:2: "));
}

} // namespace lockstep::test::shader_lines_test
