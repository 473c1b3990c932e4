#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/cli/cli_checks.hpp"

namespace lockstep::test::hostile_json_test {

using Catch::Contains;
using test::refusal;
using test::run_lockstep;

namespace {

const std::string too_deep = "arrays and objects within each other more than 64 deep";

std::string nested(int depth) { return std::string(depth, '[') + "0" + std::string(depth, ']'); }

} // namespace

TEST_CASE("hostile json: what is nested 60,000 deep is one line of error wherever JSON is read") {
    const test::TemporaryFolder folder;
    const std::string scene = folder.write("scene.json", test::small_scene).string();
    for (const int depth : {1'000, 60'000, 1'000'000}) {
        CAPTURE(depth);
        const std::string deep = folder.write("deep.json", nested(depth)).string();
        CHECK(refusal(run_lockstep({"hash", deep})) == deep + ": " + too_deep);
        CHECK(refusal(run_lockstep({"capsule", "show", deep})) == deep + ": " + too_deep);
        CHECK(refusal(run_lockstep({"study", "thesis", "--from", deep, "--json", folder.path() / "out"})) ==
              deep + ": " + too_deep);
        const std::string within =
            folder.write("within.json", R"({"emitters": [{"count": )" + nested(depth) + "}]}").string();
        CHECK(refusal(run_lockstep({"hash", within})) == within + ": " + too_deep);
    }
    CHECK_THAT(refusal(run_lockstep({"hash", scene, "--set", "tick=" + nested(60'000)})),
               Contains("120006 characters; a setting has at most 200"));
    CHECK_THAT(refusal(run_lockstep({"hash", scene, "--set", "tick=" + nested(90)})),
               Contains("is not a number above 0"));
    CHECK_THAT(refusal(run_lockstep({"hash", scene, "--set", "gravity=" + nested(90)})),
               Contains("is not a vector of three"));
}

TEST_CASE("hostile json: and in a debug session, which goes on from there") {
    if (!test::have_software_gl())
        return;
    const test::SceneSetting setting("debug");
    const auto outcome =
        run_lockstep(setting.command(), {.standard_input = "frame 2\nset tick=" + nested(20'000) + "\n"});
    CHECK(outcome.status == 2);
    CHECK(outcome.signal == 0);
    CHECK_THAT(outcome.err, Contains("40006 characters; a setting has at most 200"));
}

TEST_CASE("hostile json: bindings.json is read within the same limits") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder folder;
    const std::string scene = folder.write("scene.json", test::small_scene).string();
    std::filesystem::create_directory(folder.path() / "own");
    std::ifstream shipped("shaders/collision/collision_pass.vert");
    folder.write("own/collision_pass.vert", std::string(std::istreambuf_iterator<char>(shipped), {}));
    const auto with = [&](const std::string& bindings) {
        folder.write("own/bindings.json", bindings);
        return refusal(run_lockstep(
            {"check", scene, "--frames", "1", "--shaders", folder.path() / "own", "--gl", test::software_gl()}));
    };
    std::string objects;
    for (int depth = 0; depth < 60'000; ++depth)
        objects += R"({"a":)";
    CHECK_THAT(with(objects), Contains("bindings.json: " + too_deep));
    CHECK_THAT(with(R"({"uniforms": )" + nested(20'000) + "}"), Contains("bindings.json: " + too_deep));
    CHECK_THAT(with(R"({"uniforms": {"u_Tick": 1e999}})"),
               Contains("bindings.json:1:") && Contains("malformed JSON") && !Contains("json.exception"));
}

TEST_CASE("hostile json: a capsule without its scene's options names what is missing") {
    const test::TemporaryFolder folder;
    const std::string file = folder
                                 .write("capsule.json", R"({"lockstep_system_capsule": 1, "name": "a", "capsule": {},
                                                            "scene": {"system": "dust"}})")
                                 .string();
    CHECK(refusal(run_lockstep({"capsule", "show", file})) == file + ": /: the key \"options\" is missing");
}

} // namespace lockstep::test::hostile_json_test
