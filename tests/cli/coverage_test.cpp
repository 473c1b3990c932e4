#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/cli/cli_checks.hpp"
#include "tests/cli/run_program.hpp"
#include "tests/shipped_shaders.hpp"

namespace lockstep::test::coverage_test {

using Catch::Contains;

namespace {

/// A folder with dust's vacuum as it is, and a file of one's own that it includes.
std::string vacuum_in(const TemporaryFolder& folder, const std::string& added) {
    std::filesystem::create_directories(folder.path() / "mine");
    std::string text = shipped_text("dust/vacuum_up.comp");
    const std::string main = "void main() {\n";
    const std::size_t at = text.find(main);
    REQUIRE(at != std::string::npos);
    text.insert(at + main.size(), added);
    folder.write("mine/vacuum_up.comp", text.insert(at, "#include \"extra.glsl\"\n"));
    folder.write("mine/extra.glsl", "float doubled(float a) {\n"
                                    "    if (a < 0.0)\n"
                                    "        return 0.0;\n"
                                    "    return 2.0 * a;\n"
                                    "}\n");
    return (folder.path() / "mine").string();
}

Outcome check(const std::string& shaders, const std::vector<std::string>& more) {
    return run_lockstep(joined({"check", "data/scenes/dust/cone.json", "--particles", "2000", "--frames", "20",
                                "--no-render", "--gl", software_gl(), "--shaders", shaders},
                               more));
}

constexpr const char* examined = "#version 450 core\n"
                                 "layout(local_size_x = 8) in;\n"
                                 "layout(std430, binding = 0) buffer Out { float x[]; };\n"
                                 "uniform int u_Mode;\n"
                                 "void main() {\n"
                                 "    uint i = gl_GlobalInvocationID.x;\n"
                                 "    float v = x[i];\n"
                                 "    for (int k = 0; k < u_Mode; ++k)\n"
                                 "        v += 1.0;\n"
                                 "    if (v < 0.0)\n"
                                 "        v = 0.0;\n"
                                 "    switch (u_Mode) {\n"
                                 "    case 0:\n"
                                 "        v *= 2.0;\n"
                                 "        break;\n"
                                 "    case 1:\n"
                                 "        v *= 3.0;\n"
                                 "        break;\n"
                                 "    }\n"
                                 "    x[i] = v;\n"
                                 "}\n";

} // namespace

TEST_CASE("coverage: examine says which lines and sides its run came to, the first three by name") {
    const TemporaryFolder folder;
    const std::string file = folder.write("modes.comp", examined).string(),
                      json = (folder.path() / "found.json").string();
    const Outcome zero = run_lockstep({"examine", file, "--json", json});
    CHECK(zero.status == 0);
    CHECK_THAT(zero.out, Contains("coverage  modes.comp: 8 of 12 lines, 3 of 7 branch sides in 4 groups of 8 "
                                  "invocations; :8 loop never turned (:9 never reached), :10 was never true (:11 never "
                                  "reached), :12 case 1 was never taken, and 2 more\n"));
    const nlohmann::json coverage = nlohmann::json::parse(std::ifstream(json))["coverage"];
    REQUIRE(coverage.size() == 1);
    CHECK(coverage[0]["stage"] == "modes.comp");
    CHECK(coverage[0]["files"] ==
          nlohmann::json{{{"file", "modes.comp"}, {"lines", 12}, {"reached", 8}, {"sides", 7}, {"taken", 3}}});
    REQUIRE(coverage[0]["never"].size() == 7);
    CHECK(coverage[0]["never"][0] ==
          nlohmann::json{{"file", "modes.comp"}, {"line", 8}, {"what", "loop never turned"}});
    CHECK(coverage[0]["never"][6] ==
          nlohmann::json{{"file", "modes.comp"}, {"line", 17}, {"to", 18}, {"what", "never reached"}});
}

TEST_CASE("coverage: examine does not count what it adds to expressions of constants") {
    const TemporaryFolder folder;
    const std::string file = folder
                                 .write("constants.comp", "#version 450 core\n"
                                                          "layout(local_size_x = 8) in;\n"
                                                          "buffer Out { int x[]; };\n"
                                                          "const int kind = 1 << 1;\n"
                                                          "void main() {\n"
                                                          "    if (kind % 3 == 2)\n"
                                                          "        x[gl_GlobalInvocationID.x] = 6 / kind;\n"
                                                          "}\n")
                                 .string();
    const std::string said = run_lockstep({"examine", file}).out;
    // Newer glslang gives a condition that it folds main's line.
    CHECK((said.find("constants.comp: 1 of 1 line in 4 groups") != std::string::npos ||
           said.find("constants.comp: all 2 lines in 4 groups") != std::string::npos));
}

TEST_CASE("coverage: a check says it of the user's own shaders, with the files that they include, and of no other") {
    if (!have_software_gl())
        return;
    const TemporaryFolder folder;
    const std::string json = (folder.path() / "report.json").string();
    const Outcome said =
        check(vacuum_in(folder, "    if (doubled(deltaTime) < 0.0)\n        return;\n"), {"--json", json});
    INFO(said.out << said.err);
    CHECK(said.status == 0);
    CHECK_THAT(said.out, Contains("\ncoverage  vacuum_up.comp: ") && Contains(" was never true (:") &&
                             Contains(", extra.glsl:2 was never true (extra.glsl:3 never reached)") &&
                             !Contains("coverage  populate.comp") && !Contains("cone.glsl:"));
    const nlohmann::json report = nlohmann::json::parse(std::ifstream(json));
    REQUIRE(report["coverage"].size() == 1);
    CHECK(report["coverage"][0]["files"].size() == 2);
    CHECK(report["coverage"][0]["files"][0] ==
          nlohmann::json{{"file", "extra.glsl"}, {"lines", 3}, {"reached", 2}, {"sides", 2}, {"taken", 1}});
}

TEST_CASE("--cover-at-least: fails a run that covered less, and passes one that covered enough, in all frames") {
    if (!have_software_gl())
        return;
    const TemporaryFolder folder;
    const std::string whole = vacuum_in(folder, "");
    const Outcome enough = check(whole, {"--cover-at-least", "100%"});
    INFO(enough.out << enough.err);
    CHECK(enough.status == 0);
    CHECK_THAT(enough.out, Contains("coverage  vacuum_up.comp: all ") && Contains(" branch sides in 20 frames\n"));
    const std::string part = vacuum_in(folder, "    if (doubled(deltaTime) < 0.0)\n        return;\n");
    const Outcome less = check(part, {"--cover-at-least", "0.99"});
    CHECK(less.status == 1);
    CHECK_THAT(less.out, Contains("verdict   FAILED: the shaders' texts were covered to ") &&
                             Contains(" branch sides), expected at least 99 %; AGREE"));
    CHECK(check(part, {"--cover-at-least", "50%"}).status == 0);
}

TEST_CASE("--cover-at-least: refused where no text of the user's own is run") {
    CHECK_THAT(run_lockstep({"check", "data/scenes/dust/cone.json", "--cover-at-least", "90%"}).err,
               Contains("check: --cover-at-least goes with shaders of one's own; expected --shaders DIR"));
    const Outcome collision = run_lockstep({"check", "data/scenes/lattice.json", "--cover-at-least", "90%"});
    CHECK(collision.status == 2);
    CHECK_THAT(collision.err, Contains("--cover-at-least does not go with a scene of system collision"));
    if (!have_software_gl())
        return;
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "mine");
    folder.write("mine/draw.frag", shipped_text("dust/draw.frag"));
    const Outcome none = check((folder.path() / "mine").string(), {"--cover-at-least", "90%", "--allow-unused"});
    INFO(none.out << none.err);
    CHECK(none.status == 2);
}

} // namespace lockstep::test::coverage_test
