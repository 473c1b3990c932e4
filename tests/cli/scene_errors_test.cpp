#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "tests/cli/cli_checks.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::scene_errors_test {

using test::refusal;
using test::run_lockstep;

namespace {

/// Runs `check` with every kind of output on a scene with `text` in place of its emitters' `count`, and holds that the
/// one line of error is FILE + `message` and that no output was left.
void check_bad_scene(const std::string& text, const std::string& message) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("scene.json", text);
    CAPTURE(text);
    CHECK(refusal(run_lockstep({"check", file.string(), "--json", folder.path() / "report.json", "--hashes",
                                folder.path() / "hashes", "--images", folder.path() / "images"})) ==
          file.string() + message);
    CHECK(test::names_in(folder.path()) == std::vector<std::string>{"scene.json"});
}

std::string emitter(const std::string& keys) { return R"({"emitters": [{)" + keys + "}]}"; }

const std::string box = R"("min": [0, 0, 0], "max": [1, 1, 1])";

} // namespace

TEST_CASE("scene_errors: malformed JSON is told with line and column") {
    check_bad_scene("{\n  \"emitters\": [\n}",
                    ":3:1: malformed JSON: syntax error while parsing value - unexpected '}'; "
                    "expected '[', '{', or a literal");
    check_bad_scene("", ":1:1: malformed JSON: it is empty");
}

TEST_CASE("scene_errors: an unknown key is told with the keys there are") {
    check_bad_scene(emitter(R"("cuont": 3, )" + box),
                    R"(: /emitters/0: unknown key "cuont"; the keys here are shape, count, min, max, direction, )"
                    "direction_jitter, speed, speed_jitter, collide_time; did you mean count?");
}

TEST_CASE("scene_errors: counts below 1 are told with what is allowed") {
    check_bad_scene(emitter(R"("count": -5, )" + box), ": /emitters/0/count: -5 is not an integer from 1 to 100000000");
    check_bad_scene(emitter(R"("count": 0, )" + box), ": /emitters/0/count: 0 is not an integer from 1 to 100000000");
    check_bad_scene(R"({"emitters": []})", ": /emitters: no emitters, so no particles; a scene has at least one");
}

TEST_CASE("scene_errors: NaN in a vector is refused, however it is written") {
    check_bad_scene(emitter(R"("count": 1, "min": [0, NaN, 0], "max": [1, 1, 1])"),
                    ":1:39: malformed JSON: syntax error while parsing value - invalid literal; last read: '0, N'");
    check_bad_scene(emitter(R"("count": 1, "min": [0, "nan", 0], "max": [1, 1, 1])"),
                    R"(: /emitters/0/min/1: "nan" is not a finite number)");
    check_bad_scene(emitter(R"("count": 1, "min": [0, 1e400, 0], "max": [1, 1, 1])"),
                    ":1:43: malformed JSON: number overflow parsing '1e400'");
    check_bad_scene(emitter(R"("count": 1, "min": [0, null, 0], "max": [1, 1, 1])"),
                    ": /emitters/0/min/1: null is not a finite number");
}

TEST_CASE("scene_errors: a missing mesh and a mesh without faces are named") {
    const test::TemporaryFolder folder;
    folder.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    for (const auto& [mesh, reason] :
         {std::pair{"nowhere.obj", "no such mesh; scripts/fetch_meshes.sh fetches the bunny and the dragon"},
          std::pair{"points.obj", "the mesh has no faces; an obstacle needs at least one triangle"}}) {
        const auto file = folder.write(
            "scene.json", R"({"emitters": [{"count": 1, )" + box +
                              R"(}], "obstacles": [{"shape": "mesh", "height": 1, "file": ")" + mesh + R"("}]})");
        CHECK(refusal(run_lockstep({"hash", file.string()})) ==
              file.string() + ": /obstacles/0/file: " + (folder.path() / mesh).string() + ": " + reason);
    }
}

TEST_CASE("scene_errors: every verb that runs a scene refuses one that is not there") {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"check"}, {"render", "-o", "x.png"}, {"hash"}, {"bench"}}) {
        std::vector<std::string> all = arguments;
        all.emplace_back("nowhere.json");
        CAPTURE(all);
        CHECK(refusal(run_lockstep(all)) == "nowhere.json: cannot be read: No such file or directory");
    }
    CHECK(refusal(run_lockstep({"hash", "data/scenes"})) == "data/scenes: cannot be read: Is a directory");
}

} // namespace lockstep::test::scene_errors_test
