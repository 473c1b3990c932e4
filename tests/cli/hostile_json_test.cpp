#include <catch2/catch.hpp>

#include <string>

#include "tests/cli/cli_checks.hpp"

using namespace lockstep;
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
