#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/cli/cli_checks.hpp"
#include "tests/planted_shader.hpp"

namespace lockstep::test::shader_warnings_test {

using Catch::Contains;
using test::plant;
using test::refusal;
using test::run_lockstep;

namespace {

const std::string declared = "    bool particle_collision = false;\n";
/// Read, and of no effect: what is compared cannot show it.
const std::string junk = "    float junk; if (junk > 3.0e38) return false;\n";

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

TEST_CASE("shader warnings: a variable that is read unset is in report, JSON, JUnit and verdict, with file and line") {
    if (!test::have_software_gl())
        return;
    const test::SceneSetting setting("check");
    plant(setting.shaders, "collision_pass.vert", declared, declared + junk);
    const std::string file = (setting.shaders.path() / "collision_pass.vert").string();
    const std::string place = file + ":" + std::to_string(line_of(content(file), "junk > "));
    const std::string json = (setting.folder.path() / "report.json").string(),
                      junit = (setting.folder.path() / "junit.xml").string();
    const test::Outcome outcome =
        run_lockstep(setting.command({"--frames", "2", "--no-render", "--json", json, "--junit", junit}));
    CHECK(outcome.status == 0);
    const std::string note = "the driver warns: " + place + ": `junk' used uninitialized";
    CHECK_THAT(outcome.out, Contains("note      " + note + "\n") &&
                                Contains(", but " + place + " may read a variable that was never set"));
    const nlohmann::json report = nlohmann::json::parse(content(json));
    CHECK(std::count(report["notes"].begin(), report["notes"].end(), note) == 1);
    CHECK_THAT(content(junit), Contains("<system-out>") && Contains(note));

    const std::string refused = "shader " + place + ": `junk' used uninitialized (a warning; --werror-shaders)";
    CHECK(refusal(run_lockstep(setting.command({"--frames", "2", "--werror-shaders"}))) == refused);
    CHECK(refusal(run_lockstep({"check", "--stress", "--frames", "1", "--gl", test::software_gl(), "--shaders",
                                setting.shaders.path(), "--werror-shaders"})) == refused);
    CHECK(refusal(run_lockstep({"explain", setting.scene, "--frame", "1", "--particle", "0", "--gl",
                                test::software_gl(), "--shaders", setting.shaders.path(), "--werror-shaders"})) ==
          refused);
}

TEST_CASE("shader warnings: stages of other systems and of the rendered frame are heard, too") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder lights;
    plant(lights, "light_step_pass.comp", "void main() {",
          "float unset() { float x; return x; }\nvoid main() {\n"
          "    if (unset() > 3.0e38) return;");
    const test::Outcome outcome =
        run_lockstep({"check", "data/scenes/lights/one_light.json", "--frames", "1", "--no-render", "--gl",
                      test::software_gl(), "--shaders", lights.path()});
    CHECK_THAT(outcome.out,
               Contains("note      the driver warns: " + (lights.path() / "light_step_pass.comp").string()));
    CHECK_THAT(outcome.out, Contains("may read a variable that was never set"));
}

TEST_CASE("shader warnings: a function that reads an unset variable is UNDEFINED by its text, with the line") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder folder;
    const std::string shader =
        folder
            .write("least.glsl", "float least(float a, float b) {\n    float best;\n    best = min(best, a);\n"
                                 "    best = min(best, b);\n    return best;\n}\n")
            .string();
    const std::string table = folder.write("least.csv", "a,b,result\n0,2,0\n0,7,0\n").string();
    const test::Outcome outcome =
        run_lockstep({"function", shader, "least", "--table", table, "--gl", test::software_gl()});
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.out, Contains("least.glsl:3: use of a variable that was never set"));
}

TEST_CASE("shader warnings: a function that may read an unset variable, in no row of the table, is no plain AGREE") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder folder;
    const std::string shader = folder
                                   .write("least.glsl", "float least(float a, float b) {\n    float best;\n"
                                                        "    if (a > 100.0) return best;\n    return min(a, b);\n}\n")
                                   .string();
    const std::string table = folder.write("least.csv", "a,b,result\n0,2,0\n0,7,0\n").string();
    const std::vector<std::string> command{"function", shader, "least", "--table", table, "--gl", test::software_gl()};
    const test::Outcome outcome = run_lockstep(command);
    CHECK_THAT(outcome.out, Contains("the driver warns: least.glsl:3: `best' used uninitialized"));
    CHECK_THAT(outcome.out, Contains("AGREE, but least.glsl:3 may read a variable that was never set"));
    CHECK_THAT(refusal(run_lockstep(test::joined(command, {"--werror-shaders"}))), Contains("least.glsl:3: "));
}

TEST_CASE("shader warnings: a driver that kept the compiled shader from an earlier run is asked again") {
    if (!test::have_software_gl())
        return;
    const test::SceneSetting setting("check");
    plant(setting.shaders, "collision_pass.vert", declared, declared + junk);
    for (int run = 0; run < 2; ++run)
        CHECK_THAT(run_lockstep(setting.command({"--frames", "2", "--no-render"})).out,
                   Contains("note      the driver warns: "));
}

TEST_CASE("shader warnings: the driver warns of no shipped shader") {
    if (!test::have_software_gl())
        return;
    for (const std::string scene : {"lattice", "dust/spheres", "lifecycle/one_particle", "lifecycle/sorted_ribbon",
                                    "lights/one_light", "fluid/one_sphere"}) {
        const test::Outcome outcome = run_lockstep({"check", "data/scenes/" + scene + ".json", "--frames", "1",
                                                    "--werror-shaders", "--gl", test::software_gl()});
        INFO(scene << ": " << outcome.err);
        CHECK(outcome.status == 0);
    }
}

TEST_CASE("shader warnings: a #line does not move an error from its line in the file, and takes no file name") {
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

TEST_CASE("shader warnings: an error in the first lines of a function's file names that file") {
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

} // namespace lockstep::test::shader_warnings_test
