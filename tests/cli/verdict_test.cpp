#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/cli/cli_checks.hpp"
#include "tests/planted_shader.hpp"
#include "tests/shader_clock.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::verdict_test {

using test::run_lockstep;

namespace {

nlohmann::json json_of(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return nlohmann::json::parse(stream);
}

/// The words of a command line after the program's name.
std::vector<std::string> words(const std::string& line) {
    std::istringstream stream(line);
    std::vector<std::string> all{std::istream_iterator<std::string>(stream), {}};
    all.erase(all.begin());
    return all;
}

/// The part of a report that lists the worst differences.
std::string worst(const std::string& report) {
    const std::size_t first = report.find("  worst of frame ");
    const std::size_t last = report.find("\nrepeat");
    REQUIRE((first != std::string::npos && last != std::string::npos));
    return report.substr(first, last - first);
}

struct Setting {
    test::TemporaryFolder folder;
    test::TemporaryFolder shaders;
    std::string scene = folder.write("scene.json", test::small_scene).string();
    std::filesystem::path report = folder.path() / "report.json";

    [[nodiscard]] test::Outcome check(const std::vector<std::string>& options) const {
        return run_lockstep(test::joined(test::joined({"check", scene, "--gl", test::software_gl(), "--json", report},
                                                      test::shader_options(shaders)),
                                         options));
    }
};

} // namespace

TEST_CASE("verdict: both sides agree, status 0, and the report says on what") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const test::Outcome outcome = setting.check({"--frames", "6"});
    CHECK(outcome.status == 0);
    CHECK(outcome.err.empty());
    CHECK_THAT(outcome.out,
               Catch::Contains("verdict   AGREE: every bit of 300 particles and of the CDT in 6 frames\n"));
    const nlohmann::json report = json_of(setting.report);
    CHECK(report["verdict"] == "AGREE");
    CHECK(report["frames"] == 6);
    CHECK(report["particles"] == 300);
    CHECK(report["hits"] > 0);
    CHECK(report["fields"]["position"]["compared"] == 6 * 300 * 3);
    CHECK(report["fields"]["texel"]["compared"] == 6 * 64 * 48 * 4);
    CHECK(report["hash"]["reference"] == report["hash"]["gpu"]);
}

TEST_CASE("verdict: a planted difference is status 1, and the line that repeats it repeats it") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    test::plant(setting.shaders, "collision_pass.vert", "v_Speed = ls_length(temp);",
                "v_Speed = uintBitsToFloat(floatBitsToUint(ls_length(temp)) + 1u);");
    const test::Outcome outcome = setting.check({"--frames", "6"});
    CHECK(outcome.status == 1);
    CHECK(outcome.err.empty());
    CHECK_THAT(outcome.out, Catch::Contains("verdict   DIVERGENT from frame 0 on: 1,"));
    CHECK_THAT(outcome.out,
               Catch::Matches("(.|\n)*  frame 0 particle \\d+ \\S+: reference -?[0-9.e-]+, GPU -?[0-9.e-]+, \\d+ "
                              "ULP\n(.|\n)*") &&
                   !Catch::Contains("0x"));
    CHECK_THAT(setting.check({"--frames", "6", "--hex"}).out, Catch::Contains(": reference 0x1."));
    const nlohmann::json report = json_of(setting.report);
    CHECK(report["verdict"] == "DIVERGENT");
    CHECK(report["first_frame"] == 0);
    CHECK(report["fields"]["speed"]["differing"] > 300);

    const test::Outcome repeated = run_lockstep(words(report["repeat"]));
    CHECK(repeated.status == 1);
    CHECK_THAT(repeated.out, Catch::Contains("DIVERGENT from frame 0 on") && Catch::Contains("in 1 frame,"));
    CHECK(worst(repeated.out) == worst(outcome.out));
}

TEST_CASE("verdict: points that come from no geometry stage are placed as the driver places such points") {
    if (!test::have_software_gl())
        return;
    const test::Outcome outcome =
        run_lockstep({"check", "data/scenes/x_streams.json", "--frames", "6", "--preset", "paper", "--set",
                      "perspective_divide=off", "--set", "raster_position=before_step", "--shaders",
                      "data/examples/thesis_listing", "--gl", test::software_gl()});
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.out, !Catch::Contains("DIVERGENT"));
}

TEST_CASE("verdict: a shader that gives two answers to one frame is NONDETERMINISTIC, status 1") {
    if (!test::offers_shader_clock())
        return;
    const Setting setting;
    test::plant(setting.shaders, "collision_pass.vert", "#version 330 core\n",
                "#version 330 core\n#extension GL_ARB_shader_clock : require\n");
    test::plant(setting.shaders, "collision_pass.vert", "v_Speed = ls_length(temp);",
                "v_Speed = ls_length(temp) + float(clock2x32ARB().x & 0xffffu);");
    const test::Outcome outcome = setting.check({"--frames", "6"});
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.out, Catch::Contains("verdict   NONDETERMINISTIC: the GPU gave two answers to frame 0: ") &&
                                Catch::Contains(", second run "));
    CHECK(json_of(setting.report)["verdict"] == "NONDETERMINISTIC");
}

TEST_CASE("verdict: free mode shows how a difference grows") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    test::plant(setting.shaders, "collision_pass.vert", "v_Speed = product(a_Speed, u_SpeedFactor);",
                "v_Speed = product(a_Speed, 0.5);");
    const test::Outcome outcome = setting.check({"--frames", "6", "--mode", "free"});
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.out, Catch::Contains("growth: frame, differing particles, differing texels, worst ULP\n"));
    const nlohmann::json rows = json_of(setting.report)["counts"]["rows"];
    REQUIRE(rows.size() == 6);
    CHECK(rows[0][1] == 0);
    CHECK(rows[5][1] >= rows[1][1]);
    CHECK(rows[5][1] > 0);
}

TEST_CASE("verdict: quiet leaves the exit status to tell it") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    test::Outcome outcome = setting.check({"--frames", "2", "--quiet"});
    CHECK(outcome.status == 0);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.empty());
    test::plant(setting.shaders, "collision_pass.vert", "ls_flush(a_CollideTime) - u_Tick;",
                "ls_flush(a_CollideTime);");
    outcome = setting.check({"--frames", "2", "--quiet"});
    CHECK(outcome.status == 1);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.empty());
}

TEST_CASE("verdict: hash prints one line, the same for any number of threads, and check's hash") {
    const Setting setting;
    const std::vector<std::string> hash{"hash", setting.scene, "--frames", "6", "--profile", "llvmpipe", "--threads"};
    std::string last;
    for (const char* threads : {"1", "2", "4"}) {
        std::vector<std::string> arguments = hash;
        arguments.emplace_back(threads);
        const test::Outcome outcome = run_lockstep(arguments);
        CHECK(outcome.status == 0);
        CHECK_THAT(outcome.out, Catch::Matches("5 [0-9a-f]{16}\n"));
        CHECK((last.empty() || outcome.out == last));
        last = outcome.out;
    }
    if (!test::have_software_gl())
        return;
    const std::string exact = run_lockstep({"hash", setting.scene, "--frames", "6", "--preset", "exact"}).out;
    CHECK_THAT(setting.check({"--frames", "6", "--preset", "exact"}).out,
               Catch::Contains("hash      " + exact.substr(2, 16) + " on both"));
}

TEST_CASE("verdict: both sides render, and bench tells a verdict a row") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const auto picture = setting.folder.path() / "frame.png";
    CHECK(run_lockstep({"render", setting.scene, "--side", "gpu", "--gl", test::software_gl(), "-o", picture}).status ==
          0);
    CHECK(std::filesystem::file_size(picture) > 100);
    const test::Outcome bench = run_lockstep(
        {"bench", setting.scene, "--gl", test::software_gl(), "--frames", "2", "--counts", "100,200", "--radius", "1"});
    CHECK(bench.status == 0);
    CHECK_THAT(bench.out,
               Catch::Matches("(.|\n)*  1 +100 .* [0-9a-f]{16} AGREE\n +GL timer of each pass: clear [0-9.]+, "
                              "obstacle_pass [0-9.]+, collision_pass [0-9.]+, rendering apart [0-9.]+\n"
                              " +1 +200 .* [0-9a-f]{16} AGREE\n(.|\n)*"));
    const test::Outcome compute = run_lockstep({"bench", setting.scene, "--gl", test::software_gl(), "--frames", "2",
                                                "--counts", "100,200", "--radius", "1", "--set", "step=compute"});
    CHECK(compute.status == 0);
    CHECK_THAT(compute.out, Catch::Contains(", collision_pass ") && Catch::Contains(", collision_texels "));
}

TEST_CASE("verdict: bench says how many particles a frame at 60 and at 144 Hz has time for") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const test::Outcome bench = run_lockstep({"bench", setting.scene, "--gl", test::software_gl(), "--frames", "5",
                                              "--counts", "1000,60000", "--radius", "1"});
    CHECK_THAT(bench.out, Catch::Matches("(.|\n)* particles in 16.7 ms: [0-9,]+, with rendering [0-9,]+"
                                         "( \\(beyond what was measured\\))?; in 6.9 ms: [0-9,]+, with rendering "
                                         "[0-9,]+( \\(beyond what was measured\\))?, by the GL timer\n(.|\n)*"));
}

TEST_CASE("verdict: a run in which nothing collided says so, and fails where hits are required") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    test::Outcome outcome = setting.check({"--frames", "3", "--particles", "1"});
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.out, Catch::Contains("verdict   AGREE, but nothing collided: every bit of 1 particle and"));
    CHECK(json_of(setting.report)["untried"] == nlohmann::json{"nothing collided"});
    const std::string junit = (setting.folder.path() / "junit.xml").string();
    outcome = setting.check({"--frames", "3", "--particles", "1", "--require-hits", "--junit", junit});
    CHECK(outcome.status == 1);
    const std::string why = "FAILED: nothing collided, expected a hit; AGREE";
    CHECK_THAT(outcome.out, Catch::Contains("verdict   " + why + ": every bit of 1 particle and"));
    std::ifstream failure(junit);
    CHECK_THAT(std::string(std::istreambuf_iterator<char>(failure), {}),
               Catch::Contains("<failure message=\"" + why + "\">"));
    outcome = setting.check({"--frames", "6", "--require-hits"});
    CHECK(outcome.status == 0);
    CHECK(json_of(setting.report)["untried"].empty());
}

TEST_CASE("verdict: a run says which passes it never came to") {
    if (!test::have_software_gl())
        return;
    const std::vector<std::string> check{
        "check", "data/scenes/dust/explode.json", "--gl", test::software_gl(), "--particles", "64", "--frames"};
    CHECK_THAT(run_lockstep(test::joined(check, {"3"})).out,
               Catch::Contains("verdict   AGREE, but explode and explode_count did not run: every bit"));
    CHECK_THAT(run_lockstep(test::joined(check, {"100"})).out, !Catch::Contains("did not run"));
    const test::Outcome asked = run_lockstep(test::joined(check, {"3", "--power-at-least", "50%"}));
    CHECK(asked.status == 1);
    CHECK_THAT(asked.out, Catch::Contains("not: ") && Catch::Contains("its pass did not run"));
}

TEST_CASE("verdict: a run says which passes left all as it was") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder folder;
    std::ifstream shipped("data/scenes/dust/cone.json");
    nlohmann::json scene = nlohmann::json::parse(shipped);
    const auto check = [&] {
        const std::string path = (folder.path() / "cone.json").string();
        std::ofstream(path) << scene;
        return run_lockstep({"check", path, "--gl", test::software_gl(), "--particles", "4096", "--frames", "3"}).out;
    };
    CHECK_THAT(check(),
               Catch::Contains("no effect in 3 frames: populate_count") && Catch::Contains("AGREE: every bit"));
    scene["dust"]["tools"][0]["force"] = 0.0;
    CHECK_THAT(check(), Catch::Contains("no effect in 3 frames: populate_count, vacuum_up, vacuum_up_count") &&
                            Catch::Contains("AGREE, but 1 of 2 passes changed nothing: every bit"));
}

TEST_CASE("verdict: a run says which mistakes it would have shown, and fails where more is asked for") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    test::Outcome outcome = setting.check({"--frames", "6", "--power"});
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.out, Catch::Contains("\npower     ") &&
                                Catch::Contains("mistakes with names would have shown") &&
                                Catch::Contains("\n          hits ") && Catch::Contains("range_included"));
    const nlohmann::json power = json_of(setting.report)["power"];
    const auto seen = power["seen"].get<std::size_t>(), all = power["mistakes"].get<std::size_t>();
    REQUIRE(seen > all / 2);
    REQUIRE(seen < all);
    CHECK(power["list"].size() == all);
    CHECK(power["unseen"].size() == all - seen);
    CHECK(power["share"].get<double>() == Approx(static_cast<double>(seen) / static_cast<double>(all)));
    CHECK(setting.check({"--frames", "6", "--power-at-least", "50%"}).status == 0);
    outcome = setting.check({"--frames", "6", "--power-at-least", "0.999"});
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.out, Catch::Contains("verdict   FAILED: this run would have shown ") &&
                                Catch::Contains(" known mistakes (") &&
                                Catch::Contains(" %), expected at least 99.9 %; AGREE: every bit of"));
    CHECK(json_of(setting.report)["verdict"] == "AGREE");
    CHECK(json_of(setting.report)["failures"].size() == 1);
    outcome = setting.check({"--frames", "6", "--power-at-least", "95"});
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Catch::Contains("'95' is not a share, as 95% or 0.95"));
    CHECK(setting.check({"--frames", "6", "--power-at-least", "95%", "--mode", "free"}).status == 2);
}

TEST_CASE("verdict: the stress scenes together show 99 of 100 mistakes, and each passes with the shipped shaders") {
    if (!test::have_software_gl())
        return;
    const std::string preset = GENERATE("corrected", "paper", "exact");
    const test::TemporaryFolder folder;
    const std::string json = (folder.path() / "stress.json").string();
    const test::Outcome outcome = run_lockstep({"check", "--stress", "--preset", preset, "--gl", test::software_gl(),
                                                "--power-at-least", "99%", "--json", json});
    INFO(outcome.out << outcome.err);
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.out, Catch::Contains("verdict   all 6 scenes pass"));
    CHECK(json_of(json)["scenes"].size() == 6);
    CHECK(run_lockstep({"check", "--stress", "--trace", "run.h5"}).status == 2);
}

TEST_CASE("verdict: stress scenes that show too few mistakes fail, and a part says what asked for it") {
    if (!test::have_software_gl())
        return;
    const std::vector<std::string> stress{"check", "--stress", "--gl", test::software_gl(), "--frames", "1"};
    const test::Outcome weak = run_lockstep(test::joined(stress, {"--power-at-least", "100%"}));
    CHECK(weak.status == 1);
    CHECK_THAT(weak.out, Catch::Contains("verdict   FAILED: the scenes would have shown ") &&
                             Catch::Contains(" %), expected at least 100 %; all 6 scenes pass\n"));
    const test::Outcome part =
        run_lockstep(stress, {.environment = {{"TEST_SHARD_INDEX", "0"}, {"TEST_TOTAL_SHARDS", "6"}}});
    CHECK(part.status == 0);
    CHECK_THAT(part.out,
               Catch::Contains("part      1 of 6 scenes, by TEST_SHARD_INDEX=0 of TEST_TOTAL_SHARDS=6; lockstep") &&
                   Catch::Contains("verdict   all 1 scenes of this part pass\n"));
}

TEST_CASE("verdict: a run that draws nothing says so") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder folder;
    const std::string scene = folder.write("scene.json", R"({
      "image": [64, 48], "render": [40, 30],
      "emitters": [{ "count": 30, "min": [900, 900, 900], "max": [901, 901, 901] }]
    })");
    const test::Outcome outcome = run_lockstep({"check", scene, "--gl", test::software_gl(), "--frames", "3"});
    CHECK_THAT(outcome.out, Catch::Contains("AGREE, but nothing collided, and nothing was drawn into the CDT: every"));
}

TEST_CASE("verdict: every search is judged; free runs are compared, and say so") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    for (const char* search : {"search=cdt", "search=octree", "cdt_layers=2"}) {
        INFO(search);
        const test::Outcome outcome = setting.check({"--frames", "6", "--set", search});
        CHECK(outcome.status == 0);
        CHECK_THAT(outcome.out, Catch::Contains("verdict   AGREE: ") && !Catch::Contains("not judged\n"));
        CHECK(json_of(setting.report)["judged"] == true);
    }
    CHECK_THAT(setting.check({"--frames", "6", "--mode", "free"}).out, Catch::Contains("; compared, not judged\n"));
}

TEST_CASE("verdict: bench has check's words and status") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    const auto bench = [&](std::vector<std::string> options) {
        std::vector<std::string> arguments{"bench",    setting.scene, "--gl",     test::software_gl(),
                                           "--frames", "3",           "--radius", "1"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return run_lockstep(arguments);
    };
    test::Outcome outcome = bench({"--counts", "1"});
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.out, Catch::Contains(" AGREE, but nothing collided\n") && Catch::Contains(" at 1 particle\n") &&
                                !Catch::Contains("particles^"));
    outcome = bench({"--counts", "1", "--require-hits"});
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.out, Catch::Contains(" FAILED: nothing collided, expected a hit; AGREE\n"));
    outcome = bench({"--counts", "300", "--set", "search=octree"});
    CHECK_THAT(outcome.out, Catch::Contains(" AGREE\n"));
    test::plant(setting.shaders, "collision_pass.vert", "ls_flush(a_CollideTime) - u_Tick;",
                "ls_flush(a_CollideTime);");
    outcome = bench({"--counts", "300", "--shaders", setting.shaders.path()});
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.out, Catch::Contains(" DIVERGENT\n"));
    const test::TemporaryFolder slip;
    test::plant(slip, "collision_pass.vert", "v_Speed = ls_length(temp);",
                "v_Speed = uintBitsToFloat(floatBitsToUint(ls_length(temp)) + 1u);");
    outcome = bench({"--counts", "300", "--shaders", slip.path(), "--legal", "any_order"});
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.out, Catch::Contains(" LEGAL\n"));
}

} // namespace lockstep::test::verdict_test
