#include <catch2/catch.hpp>

#include <string>

#include <fmt/format.h>

#include "crosscheck/scene/scene_file.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/error.hpp"
#include "reference/model/state_hash.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::scene_file_test {

using lockstep::test::TemporaryFolder;

namespace {

const std::string emitters = R"("emitters": [{"count": 4, "min": [0, 0, 0], "max": [1, 1, 1]}])";

Scene load(const std::string& members, const SceneOptions& options = {}) {
    const TemporaryFolder folder;
    return load_scene(folder.write("x.json", "{" + members + "}"), options);
}

/// What load_scene says of a scene, without the folder.
std::string error_of_text(std::string_view text) {
    const TemporaryFolder folder;
    const auto file = folder.write("x.json", text);
    try {
        static_cast<void>(load_scene(file));
    } catch (const Error& error) {
        std::string what = error.what();
        for (std::size_t at = 0; (at = what.find(folder.path().string() + "/")) != std::string::npos;)
            what.erase(at, folder.path().string().size() + 1);
        return what;
    }
    return "no error";
}

/// A scene of the one member, and emitters that are right.
std::string error_of(const std::string& member) { return error_of_text("{" + member + ", " + emitters + "}"); }

std::string error_of_emitter(const std::string& member) {
    return error_of_text(R"({"emitters": [{"min": [0, 0, 0], "max": [1, 1, 1], )" + member + "}]}");
}

std::string error_of_option(const SceneOptions& options) {
    try {
        static_cast<void>(load(emitters, options));
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("scene_file: a scene of nothing but an emitter gets the defaults") {
    const Scene scene = load(emitters);
    CHECK(scene.name == "x");
    CHECK(scene.start.size() == 4);
    CHECK(scene.switches == preset("corrected"));
    CHECK(scene.width == 500);
    CHECK(scene.height == 500);
    CHECK(scene.constants.collision_range == 0.01F);
    CHECK(scene.obstacles.triangle_count() == 0);
}

TEST_CASE("scene_file: every key arrives where it belongs") {
    const Scene scene = load(R"(
        "description": "all of it", "seed": 7, "preset": "paper",
        "switches": {"cdt_format": "rgba8", "speed_factor": 0.5, "cdt_camera": "fixed"},
        "constants": {"tick": 0.02, "gravity": [0, -1, 0.5], "collision_range": 0.02, "collision_time": 0,
                      "texel_collide_range": 4, "billboard_radius": 0.1},
        "camera": {"eye": [1, 2, 3], "target": [0, 1, 0], "up": [0, 0, 1], "fov_y": 60, "near": 0.5, "far": 20},
        "camera_path": [{"frame": 0, "target": [0, 1, 0]}, {"frame": 10, "eye": [4, 5, 6], "target": [1, 1, 1]}],
        "collision_camera": {"eye": [0, 0, 5]},
        "image": [64, 32], "render": [320, 240],
        "cdt_box": {"min": [-2, -3, -4], "max": [2, 3, 4]},
        "emitters": [{"shape": "shell", "count": 10, "min": [0, 0, 0], "max": [1, 1, 1], "thickness": 0.5,
                      "direction": [1, 0, 0], "direction_jitter": 0, "speed": 2, "speed_jitter": 0},
                     {"shape": "lattice", "count": 5, "min": [0, 0, 0], "max": [1, 1, 1]}],
        "obstacles": [{"shape": "plane", "size": [1, 2]}, {"shape": "box", "size": [1, 1, 1]},
                      {"shape": "sphere", "radius": 1, "segments": 4},
                      {"shape": "torus", "radius": 1, "tube_radius": 0.2, "segments": 6,
                       "position": [0, 1, 0], "rotate_y": 90}])");
    CHECK(switch_value(scene.switches, "base_texel") == "truncate");
    CHECK(switch_value(scene.switches, "cdt_format") == "rgba8");
    CHECK(scene.switches.speed_factor == 0.5F);
    CHECK(scene.constants.tick == 0.02F);
    CHECK(scene.constants.gravity == glm::vec3(0.0F, -1.0F, 0.5F));
    CHECK(scene.constants.collision_range == 0.02F);
    CHECK(scene.constants.collision_time == 0.0F);
    CHECK(scene.constants.texel_collide_range == 4);
    CHECK(scene.constants.billboard_radius == 0.1F);
    CHECK(scene.camera.eye == glm::vec3(1.0F, 2.0F, 3.0F));
    CHECK(scene.camera.target == glm::vec3(0.0F, 1.0F, 0.0F));
    CHECK(scene.camera.up == glm::vec3(0.0F, 0.0F, 1.0F));
    CHECK(scene.camera.fov_y == 60.0F);
    CHECK(scene.camera.near_plane == 0.5F);
    CHECK(scene.camera.far_plane == 20.0F);
    REQUIRE(scene.camera_path.size() == 2);
    CHECK(scene.camera_path[0].eye == scene.camera.eye);
    CHECK(scene.camera_path[1].frame == 10);
    CHECK(scene.camera_path[1].eye == glm::vec3(4.0F, 5.0F, 6.0F));
    CHECK(scene.collision_camera.eye == glm::vec3(0.0F, 0.0F, 5.0F));
    CHECK(scene.width == 64);
    CHECK(scene.height == 32);
    CHECK(scene.render_width == 320);
    CHECK(scene.render_height == 240);
    CHECK(scene.cdt_box.max == glm::vec3(2.0F, 3.0F, 4.0F));
    CHECK(scene.start.size() == 15);
    CHECK(scene.start.speed[3] == 2.0F);
    CHECK(scene.start.direction[3] == glm::vec3(1.0F, 0.0F, 0.0F));
    CHECK(scene.obstacles.triangle_count() == 2 + 12 + 8 * 16 + 6 * 3 * 2);
}

TEST_CASE("scene_file: options override the scene: particles, preset below its switches, settings last") {
    const std::string text = R"("preset": "paper", "switches": {"base_texel": "floor"}, )" + emitters;
    SceneOptions options;
    options.particles = 1000;
    options.preset = "corrected";
    options.set = {"speed_factor=0.25", "texel_collide_range=4", "gravity=0,-2,0.5", "collision_range=0.02",
                   "speed_factor=0.75"};
    const Scene scene = load(text, options);
    CHECK(scene.start.size() == 1000);
    CHECK(switch_value(scene.switches, "self_position") == "vertex");
    CHECK(switch_value(load(text).switches, "self_position") == "texel");
    CHECK(switch_value(load(text).switches, "base_texel") == "floor");
    CHECK(scene.switches.speed_factor == 0.75F);
    CHECK(scene.constants.texel_collide_range == 4);
    CHECK(scene.constants.gravity == glm::vec3(0.0F, -2.0F, 0.5F));
    CHECK(scene.constants.collision_range == 0.02F);
    options.set = {"gravity=[1, 2, 3]"};
    CHECK(load(text, options).constants.gravity == glm::vec3(1.0F, 2.0F, 3.0F));
}

TEST_CASE("scene_file: without a collision camera of its own a fixed one stands where the camera starts") {
    CHECK(load(R"("camera": {"eye": [0, 0, 9]}, )" + emitters).collision_camera.eye == glm::vec3(0.0F, 0.0F, 9.0F));
}

TEST_CASE("scene_file: malformed JSON is told with line and column") {
    CHECK_THAT(error_of_text("{\n  \"seed\": ,\n}"), Catch::StartsWith("x.json:2:11: malformed JSON: syntax error"));
    CHECK(error_of_text("") == "x.json:1:1: malformed JSON: it is empty");
    CHECK_THAT(error_of_text("{\"seed\": 1"), Catch::StartsWith("x.json:1:10: malformed JSON: "));
    CHECK_THAT(error_of_text("{\"seed\": NaN}"), Catch::StartsWith("x.json:1:10: malformed JSON: "));
    CHECK(error_of_text("{\"constants\": {\"tick\": 1e999}}") ==
          "x.json:1:28: malformed JSON: number overflow parsing '1e999'");
    CHECK(error_of_text(R"({"seed": 1, "seed": 2})") == "x.json: /: the key \"seed\" stands twice in one object");
}

TEST_CASE("scene_file: a file that cannot be read is told with the reason") {
    CHECK_THROWS_WITH(load_scene("/nowhere/x.json"), "/nowhere/x.json: cannot be read: No such file or directory");
    const TemporaryFolder folder;
    CHECK_THROWS_WITH(load_scene(folder.path()), Catch::Contains("cannot be read: Is a directory"));
}

TEST_CASE("scene_file: what is not a scene is told with path and what is allowed") {
    const auto [text, expected] = GENERATE(table<std::string, std::string>({
        {"[]", "x.json: /: [] is not an object"},
        {"{}", "x.json: /: the key \"emitters\" is missing"},
        {R"({"emitters": []})", "x.json: /emitters: no emitters, so no particles; a scene has at least one"},
        {R"({"emitters": {}})", "x.json: /emitters: {} is not an array"},
        {R"({"emitters": [5]})", "x.json: /emitters/0: 5 is not an object"},
        {R"({"emitters": [{"min": [0, 0, 0]}]})", "x.json: /emitters/0: the key \"count\" is missing"},
        {R"({"emitters": [{"count": 1, "min": [0, 0, 0]}]})", "x.json: /emitters/0: the key \"max\" is missing"},
        {R"({"emitters": [{"count": 1, "min": [0, 2, 0], "max": [1, 1, 1]}]})",
         "x.json: /emitters/0: min is above max in y; a box goes from its lowest to its highest corner"},
        {R"({"emitters": [{"count": 60000000, "min": [0, 0, 0], "max": [1, 1, 1]},
                          {"count": 60000000, "min": [0, 0, 0], "max": [1, 1, 1]}]})",
         "x.json: /emitters/1: 120000000 particles up to here; a scene has at most 100000000"},
    }));
    CHECK(error_of_text(text) == expected);
}

TEST_CASE("scene_file: an emitter that is wrong is told with path and what is allowed") {
    const std::string keys = "shape, count, min, max, direction, direction_jitter, speed, speed_jitter, collide_time";
    const auto [member, expected] = GENERATE_COPY(table<std::string, std::string>({
        {R"("count": -5)", "/count: -5 is not an integer from 1 to 100000000"},
        {R"("count": 0)", "/count: 0 is not an integer from 1 to 100000000"},
        {R"("count": 1.5)", "/count: 1.5 is not an integer from 1 to 100000000"},
        {R"("count": "many")", "/count: \"many\" is not an integer from 1 to 100000000"},
        {R"("count": 18446744073709551615)", "/count: 18446744073709551615 is not an integer from 1 to 100000000"},
        {R"("count": 1, "colour": 1)", ": unknown key \"colour\"; the keys here are " + keys},
        {R"("count": 1, "thickness": 1)", ": unknown key \"thickness\"; the keys here are " + keys},
        {R"("count": 1, "shape": "ring")", "/shape: \"ring\" is not one of box, lattice, shell"},
        {R"("count": 1, "shape": 3)", "/shape: 3 is not one of box, lattice, shell"},
        {R"("count": 1, "shape": "shell", "thickness": 2)", "/thickness: 2 is not a fraction from 0 to 1"},
        {R"("count": 1, "direction": [0, null, 0])", "/direction/1: null is not a finite number"},
        {R"("count": 1, "direction": [0, "nan", 0])", "/direction/1: \"nan\" is not a finite number"},
        {R"("count": 1, "direction": [0, 1e39, 0])", "/direction/1: 1e+39 is beyond what a float holds, 3.4e38"},
        {R"("count": 1, "direction": [0, 1])", "/direction: [0,1] is not a vector of three finite numbers, [x, y, z]"},
        {R"("count": 1, "direction": 1)", "/direction: 1 is not a vector of three finite numbers, [x, y, z]"},
        {R"("count": 1, "direction": [0, 0, 0])", "/direction: a direction has a length above 0"},
        {R"("count": 1, "direction_jitter": 0.6)", "/direction_jitter: 0.6 is not a number from 0 to 0.5"},
        {R"("count": 1, "speed": -1)", "/speed: -1 is not a number from 0 up"},
        {R"("count": 1, "speed": true)", "/speed: true is not a number from 0 up"},
        {R"("count": 1, "collide_time": "now")", "/collide_time: \"now\" is not a finite number"},
        {R"("count": 1, "speed_jitter": -0.1)", "/speed_jitter: -0.1 is not a fraction from 0 to 1"},
    }));
    CHECK(error_of_emitter(member) == "x.json: /emitters/0" + expected);
}

TEST_CASE("scene_file: a member that is wrong is told with path and what is allowed") {
    const auto [member, expected] = GENERATE(table<std::string, std::string>({
        {R"("particels": 3)",
         "/: unknown key \"particels\"; the keys here are description, system, seed, preset, "
         "switches, constants, camera, "
         "camera_path, collision_camera, image, render, cdt_box, clip_space, frames, start, emitters, obstacles"},
        {R"("description": 3)", "/description: 3 is not a text"},
        {R"("seed": -1)", "/seed: -1 is not an integer from 0 to 9007199254740991"},
        {R"("preset": "papper")",
         "/preset: unknown preset 'papper'; the presets are listing, paper, corrected, exact; did you mean paper?"},
        {R"("switches": [])", "/switches: [] is not an object"},
        {R"("switches": {"base_texel": "round"})", "/switches/base_texel: \"round\" is not one of truncate, floor"},
        {R"("switches": {"base_texel": 1})", "/switches/base_texel: 1 is not one of truncate, floor"},
        {R"("switches": {"speed_factor": "fast"})", "/switches/speed_factor: \"fast\" is not a finite number"},
        {R"("constants": {"ticks": 1})",
         "/constants: unknown key \"ticks\"; the keys here are tick, gravity, collision_range, collision_time, "
         "texel_collide_range, billboard_radius, octree_size, surface_thickness; did you mean tick?"},
        {R"("constants": {"tick": 0})", "/constants/tick: 0 is not a number above 0"},
        {R"("constants": {"tick": 1e-39})", "/constants/tick: 1e-39 is not a normal float, which is 1.2e-38 or more"},
        {R"("constants": {"collision_range": -0.01})", "/constants/collision_range: -0.01 is not a number above 0"},
        {R"("constants": {"collision_time": -1})", "/constants/collision_time: -1 is not a number from 0 up"},
        {R"("constants": {"texel_collide_range": -1})",
         "/constants/texel_collide_range: -1 is not an integer from 0 to 64"},
        {R"("constants": {"gravity": [0, null, 0]})", "/constants/gravity/1: null is not a finite number"},
        {R"("camera": {"near": 10, "far": 1})", "/camera: near 10 is not below far 1"},
        {R"("camera": {"near": 0})", "/camera/near: 0 is not a number above 0"},
        {R"("camera": {"fov_y": 180})", "/camera/fov_y: 180 is not an angle from 1 to 179 degrees"},
        {R"("camera": {"eye": [0, 0, 0]})",
         "/camera: eye, target and up lie on one line; the camera needs a direction of view and another one up"},
        {R"("camera": {"eye": [0, 3, 0]})",
         "/camera: eye, target and up lie on one line; the camera needs a direction of view and another one up"},
        {R"("camera": {"fov": 45})",
         "/camera: unknown key \"fov\"; the keys here are eye, target, up, fov_y, near, far"},
        {R"("camera_path": [{"frame": 5}, {"frame": 5}])",
         "/camera_path/1: frame 5 does not come after frame 5; keys are sorted by frame"},
        {R"("camera_path": [{"frame": -1}])", "/camera_path/0/frame: -1 is not an integer from 0 to 1000000000"},
        {R"("camera_path": [{"frame": 0, "eye": [0, 1, 0]}])",
         "/camera_path/0: eye, target and the camera's up lie on one line"},
        {R"("collision_camera": {"near": 2, "far": 2})", "/collision_camera: near 2 is not below far 2"},
        {R"("image": [500])", "/image: a size is two integers, [width, height]"},
        {R"("image": [0, 500])", "/image/0: 0 is not an integer from 1 to 16384"},
        {R"("render": [800, 800.5])", "/render/1: 800.5 is not an integer from 1 to 16384"},
        {R"("cdt_box": {"min": [0, 0, 0], "max": [1, 0, 1]})", "/cdt_box: the box has no extent in y"},
        {R"("cdt_box": {"min": [0, 0, 0]})", "/cdt_box: the key \"max\" is missing"},
    }));
    CHECK(error_of(member) == "x.json: " + expected);
}

TEST_CASE("scene_file: an obstacle that is wrong is told with path and what is allowed") {
    const auto [members, expected] = GENERATE(table<std::string, std::string>({
        {R"("size": [1, 1])", ": the key \"shape\" is missing"},
        {R"("shape": "cone")", "/shape: \"cone\" is not one of mesh, plane, box, sphere, torus"},
        {R"("shape": "sphere")", ": the key \"radius\" is missing"},
        {R"("shape": "sphere", "radius": 0)", "/radius: 0 is not a number above 0"},
        {R"("shape": "sphere", "radius": 1, "segments": 1000)", "/segments: 1000 is not an integer from 4 to 512"},
        {R"("shape": "sphere", "radius": 1, "size": 1)",
         ": unknown key \"size\"; the keys here are shape, radius, segments, position, rotate_y"},
        {R"("shape": "plane", "size": [1])", "/size: the size of a plane is two numbers above 0, [x, z]"},
        {R"("shape": "plane", "size": [1, -1])", "/size/1: -1 is not a number above 0"},
        {R"("shape": "box", "size": [1, 1, 0])", "/size/2: 0 is not a number above 0"},
        {R"("shape": "torus", "radius": 1)", ": the key \"tube_radius\" is missing"},
        {R"("shape": "plane", "size": [1, 1], "position": [0, 0])",
         "/position: [0,0] is not a vector of three finite numbers, [x, y, z]"},
        {R"("shape": "plane", "size": [1, 1], "rotate_y": "left")", "/rotate_y: \"left\" is not a finite number"},
        {R"("shape": "mesh", "file": "a.obj")", ": the key \"height\" is missing"},
        {R"("shape": "mesh", "height": 1)", ": the key \"file\" is missing"},
        {R"("shape": "mesh", "height": 1, "file": 3)", "/file: 3 is not a text"},
        {R"("shape": "mesh", "height": 1, "file": "bunny.obj")",
         "/file: bunny.obj: no such mesh; scripts/fetch_meshes.sh fetches the bunny and the dragon"},
    }));
    CHECK(error_of(R"("obstacles": [{)" + members + "}]") == "x.json: /obstacles/0" + expected);
}

TEST_CASE("scene_file: a few numbers cannot ask for any number of triangles") {
    const std::string large = R"({"shape": "sphere", "radius": 1, "segments": 512})";
    CHECK(error_of(R"("obstacles": [)" + large + ", " + large +
                   R"(, {"shape": "torus", "radius": 1, "tube_radius": 0.1}])") ==
          "x.json: /obstacles/2: 4196608 triangles up to here; a scene has at most 4194304 (lockstep-decimate makes "
          "smaller meshes)");
    for (const char* const small : {R"({"shape": "plane", "size": [1, 1]})", R"({"shape": "box", "size": [1, 1, 1]})"})
        CHECK_THAT(error_of(R"("obstacles": [)" + large + ", " + large + ", " + small + "]"),
                   Catch::StartsWith("x.json: /obstacles/2: 41943") && Catch::Contains("a scene has at most 4194304"));
    std::string many = large;
    for (int i = 0; i < 200; ++i)
        many += ", " + large;
    CHECK_THAT(error_of(R"("obstacles": [)" + many + "]"),
               Catch::StartsWith("x.json: /obstacles/2: 6291456 triangles"));
}

TEST_CASE("scene_file: an option that is wrong is told with what is allowed") {
    SceneOptions options;
    options.particles = 0;
    CHECK(error_of_option(options) == "--particles 0: not an integer from 1 to 100000000");
    options = {};
    options.preset = "papper";
    CHECK(error_of_option(options) ==
          "unknown preset 'papper'; the presets are listing, paper, corrected, exact; did you mean paper?");
    const auto [setting, expected] = GENERATE(table<std::string, std::string>({
        {"floor", "--set floor: a setting is name=value"},
        {"tick=0", "--set: tick: 0 is not a number above 0"},
        {"tick=fast", "--set: tick: \"fast\" is not a number above 0"},
        {"tick=", "--set: tick: \"\" is not a number above 0"},
        {"tick=nan", "--set: tick: \"nan\" is not a number above 0"},
        {"gravity=0,1", "--set: gravity: [0,1] is not a vector of three finite numbers, [x, y, z]"},
        {"base_texel=round", "switch base_texel: 'round' is not one of truncate, floor"},
    }));
    options = {};
    options.set = {setting};
    CHECK(error_of_option(options) == expected);
    options.set = {"warp=9"};
    CHECK_THAT(error_of_option(options),
               Catch::StartsWith("--set warp=9: nothing is named 'warp'; the switches are perspective_divide, ") &&
                   Catch::EndsWith("; the constants are tick, gravity, collision_range, collision_time, "
                                   "texel_collide_range, billboard_radius, octree_size, surface_thickness"));
}

TEST_CASE("scene_file: a long value is cut short and stays on one line") {
    const std::string what = error_of("\"seed\": \"" + std::string(1000, 'x') + "\\n\"");
    CHECK(what.size() < 150);
    CHECK(error_of("\"seed\": \"a\\nb\"") == "x.json: /seed: \"a\\nb\" is not an integer from 0 to 9007199254740991");
}

} // namespace lockstep::test::scene_file_test
