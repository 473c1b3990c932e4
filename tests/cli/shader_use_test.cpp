#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "tests/cli/cli_checks.hpp"
#include "tests/planted_shader.hpp"

namespace lockstep::test::shader_use_test {

using Catch::Contains;
using test::refusal;
using test::run_lockstep;

namespace {

const std::string not_run = " would not run in this scene with these switches; what can is ";
const std::string state = "collision_pass.vert, collision_pass.geom, collision_pass.frag, obstacle_pass.vert, "
                          "obstacle_pass.geom, obstacle_pass.frag";
const std::string picture = ", render_background.vert, render_background.frag, render_obstacles.vert, "
                            "render_obstacles.geom, render_obstacles.frag, render_pass.vert, render_pass.geom, "
                            "render_pass.frag";
const std::string possible = not_run + state + picture + ", and files they include";

/// A shader that is not the shipped one, and computes the same.
void write_own(const test::TemporaryFolder& folder, const std::string& file) {
    std::ifstream stream("shaders/collision/" + file);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    folder.write(file, text + "// Mine.\n");
}

} // namespace

TEST_CASE("shader use: a folder of which nothing would run is status 2 with the names that would") {
    const test::SceneSetting setting("check");
    const std::vector<std::string> check{"check", setting.scene,       "--frames",  "2",
                                         "--gl",  test::software_gl(), "--shaders", setting.shaders.path()};
    const std::string folder = "shader folder " + setting.shaders.path().string() + ": ";
    SECTION("empty, or without shaders") {
        CHECK_THAT(refusal(run_lockstep(check)),
                   Catch::StartsWith(folder + "nothing in it would run in this scene with these switches; what can is "
                                              "collision_pass.vert, "));
        setting.shaders.write("notes.txt", "none yet");
        CHECK_THAT(refusal(run_lockstep(check)), Contains("nothing in it would run"));
    }
    for (const char* misspelt : {"collision.vs", "colision_pass.vert", "collision_pass.comp", "Collision_Pass.vert",
                                 "collision_pass.vert.txt", "collision_pass.VERT", "arithmetics.glsl"})
        SECTION(misspelt) {
            setting.shaders.write(misspelt, "#version 330 core\nvoid main() {}\n");
            const std::string right = misspelt == std::string("collision_pass.comp")
                                          ? "; collision_pass.comp runs with --set step=compute"
                                          : "";
            CHECK(refusal(run_lockstep(check)) == folder + misspelt + possible + right);
            write_own(setting.shaders, "collision_pass.frag");
            CHECK(refusal(run_lockstep(check)) ==
                  folder + misspelt + possible + right + "; --allow-unused lets others lie there");
        }
    for (const auto& [other, setting_for_it] : {std::pair{"octree_pass.comp", "search=octree"},
                                                {"obstacle_vertices.vert", "obstacles_in_cdt=vertices"},
                                                {"layered_cdt.frag", "cdt_layers=2"}})
        SECTION(other) {
            write_own(setting.shaders, other);
            for (const char* verb : {"check", "explain", "bench", "record", "debug"}) {
                INFO(verb);
                std::vector<std::string> arguments{verb,        setting.scene,         "--gl", test::software_gl(),
                                                   "--shaders", setting.shaders.path()};
                if (verb == std::string("explain"))
                    arguments = test::joined(arguments, {"--frame", "1", "--particle", "1"});
                if (verb == std::string("record"))
                    arguments = test::joined(arguments, {"-o", setting.folder.path() / "run.h5"});
                CHECK(refusal(run_lockstep(arguments)) ==
                      folder + other + not_run + state + (verb == std::string("check") ? picture : "") +
                          ", and files they include; " + other + " runs with --set " + setting_for_it);
            }
        }
    SECTION("what draws the picture lies beside the step that is explained") {
        write_own(setting.shaders, "render_pass.frag");
        const std::vector<std::string> explain{
            "explain", setting.scene,      "--frame", "1", "--particle", "1", "--shaders", setting.shaders.path(),
            "--gl",    test::software_gl()};
        CHECK(refusal(run_lockstep(explain)) == folder.substr(0, folder.size() - 1) +
                                                    " nothing in it would run in this scene with these switches; what "
                                                    "can is " +
                                                    state + ", and files they include");
        write_own(setting.shaders, "collision_pass.vert");
        CHECK(run_lockstep(explain).status == 0);
    }
}

TEST_CASE("shader use: what is no file in a shader's place is refused, and neither a pipe nor a device is read") {
    if (!test::have_software_gl())
        return test::skip("no software GL");
    const auto refused = [](const test::TemporaryFolder& shaders, const std::string& option) {
        return refusal(run_lockstep({"check", "data/scenes/dust/box.json", "--frames", "1", "--no-render", "--gl",
                                     test::software_gl(), option, shaders.path()}));
    };
    for (const std::string option : {"--shaders", "--reference"})
        for (const std::string name : {"update.comp", "other.glsl"}) {
            const test::TemporaryFolder pipe, device, folder;
            REQUIRE(mkfifo((pipe.path() / name).c_str(), S_IRUSR | S_IWUSR) == 0);
            std::filesystem::create_symlink("/dev/zero", device.path() / name);
            std::filesystem::create_directory(folder.path() / name);
            const bool is_stage = name == "update.comp";
            for (const test::TemporaryFolder* one : {&pipe, &device})
                CHECK_THAT(refused(*one, option),
                           Contains(is_stage ? "update.comp: is a pipe or a device; right is a file"
                                             : "other.glsl would not run"));
            CHECK_THAT(refused(folder, option),
                       Contains(is_stage ? "update.comp: is a folder; right is a file" : "nothing in it would run"));
        }
}

TEST_CASE("shader use: an include that no branch takes is status 2, as one that nobody includes") {
    const test::TemporaryFolder shaders;
    std::ifstream stream("shaders/fluid/narrow_range.glsl");
    shaders.write("narrow_range.glsl", std::string{std::istreambuf_iterator<char>(stream), {}} + "#error mine\n");
    const std::vector<std::string> check{"check",     "data/scenes/fluid/one_sphere.json",
                                         "--frames",  "1",
                                         "--gl",      test::software_gl(),
                                         "--shaders", shaders.path(),
                                         "--set",     "filter=bilateral"};
    CHECK_THAT(refusal(run_lockstep(check)), Contains("narrow_range.glsl" + not_run));
    std::vector<std::string> taken = check;
    taken.back() = "filter=narrow_range";
    CHECK_THAT(refusal(run_lockstep(taken)), Contains("mine"));
}

TEST_CASE("shader use: with step = compute the compute stage runs, and the vertex stage is told to be unused") {
    if (!test::have_software_gl())
        return;
    const test::SceneSetting setting("check");
    write_own(setting.shaders, "collision_pass.comp");
    const std::string own = setting.shaders.path().string();
    const test::Outcome outcome = run_lockstep(setting.command({"--frames", "2", "--set", "step=compute"}));
    INFO(outcome.err);
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.out,
               Contains("\nshaders   foreign: " + own +
                        "/collision_pass.comp; shipped: "
                        "clear_nearest.comp, nearest_particle.comp, collision_texels.vert, collision_texels.frag, ") &&
                   Contains(", compute)"));
    write_own(setting.shaders, "clear_nearest.comp");
    CHECK_THAT(run_lockstep(setting.command({"--frames", "2", "--set", "step=compute"})).out,
               Contains(own + "/clear_nearest.comp") && !Contains("clear_nearest.comp (compiled)"));
    write_own(setting.shaders, "collision_pass.vert");
    CHECK_THAT(refusal(run_lockstep(setting.command({"--frames", "2", "--set", "step=compute"}))),
               Contains("collision_pass.vert would not run") &&
                   Contains("; collision_pass.vert runs with --set step=transform_feedback"));
    for (const char* other : {"search=octree", "cdt_layers=3"})
        CHECK_THAT(refusal(run_lockstep({"check", setting.scene, "--set", "step=compute", "--set", other})),
                   Contains("switch step: ") && Contains("transform_feedback, not compute"));
}

TEST_CASE("shader use: the report has whose stages ran, file by file") {
    if (!test::have_software_gl())
        return;
    const test::SceneSetting setting("check");
    const std::string json = setting.folder.path() / "report.json";
    const auto shaders_line = [&](const std::vector<std::string>& options) {
        const test::Outcome outcome = run_lockstep(test::joined(setting.command(options), {"--frames", "2"}));
        INFO(outcome.err);
        CHECK(outcome.status == 0);
        const std::size_t place = outcome.out.find("\nshaders   ");
        REQUIRE(place != std::string::npos);
        return outcome.out.substr(place + 11, outcome.out.find('\n', place + 1) - place - 11);
    };
    CHECK(shaders_line({}) == "shipped: " + state + picture);
    const std::string own = setting.shaders.path().string();
    write_own(setting.shaders, "collision_pass.frag");
    write_own(setting.shaders, "clip_volume.glsl");
    std::filesystem::copy_file("shaders/collision/collision_pass.vert", own + "/collision_pass.vert");
    std::filesystem::copy_file("shaders/collision/octree_pass.comp", own + "/octree_pass.comp");
    CHECK(shaders_line({"--json", json}) ==
          "foreign: " + own + "/collision_pass.vert (as shipped), " + own + "/clip_volume.glsl, " + own +
              "/collision_pass.frag; shipped: collision_pass.geom, obstacle_pass.vert, obstacle_pass.geom, "
              "obstacle_pass.frag" +
              picture);
    std::ifstream stream(json);
    const nlohmann::json files = nlohmann::json::parse(stream)["shaders"]["files"];
    CHECK(files[0]["file"] == "collision_pass.vert");
    CHECK(files[0]["same_as_shipped"] == true);
    write_own(setting.shaders, "obstacle_vertices.vert");
    CHECK_THAT(shaders_line({"--allow-unused"}), Catch::EndsWith("; not run: obstacle_vertices.vert"));
}

TEST_CASE("shader use: the rendered frame is compared, and the report says where not") {
    if (!test::have_software_gl())
        return;
    const test::SceneSetting setting("check");
    CHECK_THAT(run_lockstep(setting.command({"--frames", "2", "--no-render"})).out,
               Contains("\nrender    the rendered frame was not compared (--no-render)\n"));
    test::Outcome outcome = run_lockstep(setting.command({"--frames", "4"}));
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.out,
               Contains("\nrender    AGREE: every one of 1,200 pixels of frame 3, 1 of which show particles\n"));
    CHECK_THAT(run_lockstep(setting.command({"--frames", "2", "--render"})).out,
               Contains("verdict   AGREE, but the rendered frame shows no particle: "));
    test::plant(setting.shaders, "render_pass.frag", "void main() {", "void main() { if (true) discard;");
    outcome = run_lockstep(setting.command({"--frames", "4"}));
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.out,
               Contains("\nrender    DIVERGENT: 1 of 1,200 pixels of frame 3, 1 of which show particles; "
                        "0 rounding, 0 tie, 0 undefined\n"
                        "          cause: sprites_not_drawn (no particle is drawn)\n") &&
                   Contains("\n          first: pixel (24, 11): reference #406db2 of particle 49, GPU #22252c\n") &&
                   Contains("verdict   DIVERGENT in the rendered frame: 1 of 1,200 pixels, which no legal "
                            "run explains; the state itself AGREE: "));
}

TEST_CASE("shader use: what draws a picture is compiled where it is not judged, in every system") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder shaders;
    const auto check = [&](const std::string& scene, const std::vector<std::string>& options) {
        return run_lockstep(test::joined({"check", "data/scenes/" + scene + ".json", "--particles", "300", "--frames",
                                          "3", "--gl", test::software_gl(), "--shaders", shaders.path().string()},
                                         options));
    };
    const std::vector<std::string> no_render{"--no-render"};
    const auto own = [&](const std::string& file, const std::string& shipped) {
        std::ifstream stream("shaders/" + shipped);
        shaders.write(file, std::string{std::istreambuf_iterator<char>(stream), {}} + "// Mine.\n");
    };
    struct Case {
        std::string scene, folder, step, vertex, fragment;
    };
    for (const Case& c : {Case{"dust/free_fall", "dust/", "update.comp", "draw.vert", "draw.frag"},
                          {"lifecycle/embers", "lifecycle/", "move.comp", "draw.vert", "draw.frag"},
                          {"lattice", "collision/", "collision_pass.vert", "render_pass.vert", "render_pass.frag"}}) {
        DYNAMIC_SECTION(c.scene) {
            const std::string broken = "#version 430 core\n#error this does not compile\n";
            for (const std::string& file : {c.vertex, c.fragment}) {
                INFO(file);
                shaders.write(file, broken);
                for (const std::vector<std::string>& options : {std::vector<std::string>{}, no_render})
                    CHECK(check(c.scene, options).status == 2);
                own(c.step, c.folder + c.step); // now something of the folder runs
                for (const std::vector<std::string>& options : {std::vector<std::string>{}, no_render})
                    CHECK_THAT(refusal(check(c.scene, options)), Contains(file + ":2: ") || Contains(file + ":"));
                own(file, c.folder + file);
                const test::Outcome outcome = check(c.scene, no_render);
                INFO(outcome.err);
                CHECK(outcome.status == 0);
                CHECK_THAT(outcome.out, Contains("foreign: " + (shaders.path() / c.step).string() + "; ") &&
                                            Contains("; not run: " + file + " (compiled)\n"));
                std::filesystem::remove(shaders.path() / file);
                std::filesystem::remove(shaders.path() / c.step);
            }
            if (c.folder != "collision/") {
                own(c.vertex, c.folder + c.vertex);
                own(c.fragment, c.folder + c.fragment);
                CHECK_THAT(check(c.scene, {}).out,
                           Contains("foreign: " + (shaders.path() / c.vertex).string() + "; ") &&
                               Contains("; not run: " + c.fragment + " (compiled)\n"));
            }
        }
    }
}

TEST_CASE("shader use: a folder named as the shipped one has foreign files alone") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "shaders");
    std::ifstream stream("shaders/collision/collision_pass.vert");
    folder.write("shaders/collision_pass.vert", std::string{std::istreambuf_iterator<char>(stream), {}} + "// Mine.\n");
    const std::string scene = folder.write("scene.json", test::small_scene).string();
    test::Surroundings there;
    there.folder = folder.path().string();
    there.environment = {{"LOCKSTEP_DATA", std::filesystem::current_path().string()}};
    const test::Outcome outcome =
        run_lockstep({"check", scene, "--frames", "2", "--gl", test::software_gl(), "--shaders", "shaders"}, there);
    INFO(outcome.err);
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.out, Contains("\nshaders   foreign: shaders/collision_pass.vert; shipped: "));
}

} // namespace lockstep::test::shader_use_test
