#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "crosscheck/dust/scene.hpp"
#include "reference/model/state_hash.hpp"
#include "tests/dust/one_grain.hpp"

namespace lockstep::test::scenes_test {

namespace dust = lockstep::dust;

namespace {

constexpr int frames = 150;
constexpr std::size_t grains = 2000;

const std::string folder = "data/scenes/dust/";

std::vector<std::string> scenes() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".json")
            names.push_back(entry.path().stem());
    std::sort(names.begin(), names.end());
    return names;
}

dust::Settings scene(const std::string& name, const std::string& preset) {
    return dust::load_scene(folder + name + ".json", {.particles = grains, .preset = preset});
}

std::map<std::string, std::string> golden() {
    std::ifstream stream("data/golden/dust/exact.json");
    const nlohmann::json file = nlohmann::json::parse(stream);
    REQUIRE(file.at("frames") == frames);
    REQUIRE(file.at("grains") == grains);
    return file.at("hashes");
}

/// The state after the frames, of the reference alone.
std::string reference_hash(const dust::Settings& settings) {
    const System system = dust::system(host_of(settings));
    ReferenceRun run(system, named_profile("strict"));
    for (int frame = 0; frame < frames; ++frame)
        run.step(frame);
    return hash_text(run.hash());
}

} // namespace

TEST_CASE("dust scenes: each has its kept hash in preset exact") {
    const std::map<std::string, std::string> kept = golden();
    const std::vector<std::string> all = scenes();
    CHECK(all.size() == kept.size());
    for (const std::string& name : all) {
        INFO(name);
        CHECK(reference_hash(scene(name, "exact")) == kept.at(name));
    }
}

TEST_CASE("dust scenes: no bit differs in resync, and in preset exact the free run ends with the kept hash") {
    if (!gl())
        return skip(gl().missing());
    const std::map<std::string, std::string> kept = golden();
    for (const std::string& name : scenes()) {
        INFO(name);
        const CheckReport corrected = run_dust(scene(name, "corrected"), frames);
        CHECK(corrected.verdict == Verdict::agree);
        const CheckReport exact = run_dust(scene(name, "exact"), frames, CheckMode::free);
        CHECK(exact.verdict == Verdict::agree);
        CHECK(hash_text(exact.gpu_hash) == kept.at(name));
    }
}

/// Writes the hashes anew: lockstep_tests_dust "[golden]" > data/golden/dust/exact.json
TEST_CASE("dust scenes: hashes to keep", "[.][golden]") {
    nlohmann::json file{{"frames", frames}, {"grains", grains}, {"hashes", nlohmann::json::object()}};
    for (const std::string& name : scenes())
        file["hashes"][name] = reference_hash(scene(name, "exact"));
    std::ofstream("data/golden/dust/exact.json") << file.dump(2) << "\n";
}

TEST_CASE("dust scenes: what is wrong with a file is said in one line, with its place") {
    const auto error_of = [](const std::string& text) -> std::string {
        try {
            const nlohmann::json document = parse_json(text, "scene.json");
            static_cast<void>(dust::read_scene(JsonValue(document, "scene.json")));
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    const auto of_dust = [](const std::string& inside) { return R"({"system": "dust", "dust": {)" + inside + "}}"; };
    CHECK(error_of(of_dust("")) == "");
    const std::pair<const char*, const char*> wrong[] = {
        {R"("count": 0)", "/dust/count"},
        {R"("count": 4194241)", "/dust/count"},
        {R"("mass": 0)", "mass is 0; right is above 0"},
        {R"("air_resistance": -1)", "air_resistance is -1; right is 0 or above"},
        {R"("stage": "s18")", "there is no stage 's18'"},
        {R"("spawn": {"min": [0, 0, 0], "max": [0, 5, 5]})", "spawn: 0 m wide in x"},
        {R"("spawn": {"min": [5, 0, 0], "max": [0, 5, 5]})", "/dust/spawn/min/0: spawn: min.x is 5, above max, 0"},
        {R"("spawn": {"min": [0, 0, 7], "max": [1, 1, 1]})", "/dust/spawn/min/2: spawn: min.z is 7, above max, 1"},
        {R"("world": {"min": [9, 0, 0], "max": [1, 1, 1]})", "/dust/world/min/0: world: min.x is 9, above max, 1"},
        {R"("tools": [{"tool": "vacuum", "angle": 91}])", "angle of 91 degrees; right is 0.01 to 90"},
        {R"("tools": [{"tool": "broom"}])", "/dust/tools/0/tool"},
        {R"("tools": [{"tool": "emit", "from": 9, "to": 3}])", "is on from 9 to 3"},
        {R"("colliders": [{"shape": "sphere", "radius": 0}])", "sphere 0 has radius 0"},
        {R"("colliders": [{"shape": "box", "scale": [1, 0, 1]}])",
         "/dust/colliders/0/scale/1: colliders: box 0 has a scale.y of 0; right is above 0"},
        {R"("controller": [])", "there is no keyframe"},
        {R"("controller": [{"forward": [0, 0, 0]}])", "keyframe 0: forward has no length"},
        {R"("colour": 3)", "colour"},
        {R"("mass": -1)", "mass is -1; right is above 0"},
        {R"("scale": 0)", "scale is 0; right is above 0"},
        {R"("elasticity": 1.5)", "elasticity is 1.5; right is 0 to 1"},
        {R"("mass": 1e999)", "number overflow"},
        {R"("gravity": [0, -9.8, 0])", "gravity"},
        {R"("tools": [{"tool": "vacuum", "force": 1e20}])",
         "/dust/tools/0/force: tools: 0 has a force of 1e+20; right is 0 to 1.8e19, since it is squared"},
        {R"("tools": [{"tool": "vacuum", "death_range": -1}])",
         "/dust/tools/0/death_range: tools: 0 has a death_range of -1; right is 0 to 1.8e19"},
        {R"("tools": [{"tool": "wind", "range": -20}])",
         "/dust/tools/0/range: tools: 0 has a range of -20; right is 0"},
        {R"("tools": [{"tool": "wind", "death_range": 1}])", "/dust/tools/0/death_range: is no property of wind"},
        {R"("tools": [{"tool": "emit", "death_range": 1}])", "/dust/tools/0/death_range: is no property of emit"},
        {R"("tools": [{"tool": "emit", "range": 3}])", "/dust/tools/0/range: is no property of emit"},
        {R"("tools": [{"tool": "vacuum", "distance": 3}])", "/dust/tools/0/distance: is no property of vacuum"},
        {R"("tools": [{"tool": "wind", "distance": 3}])", "/dust/tools/0/distance: is no property of wind"},
        {R"("tools": [{"tool": "emit", "angle": 0}])", "angle of 0 degrees; right is 0.01 to 90"},
        {R"("colliders": [{"shape": "sphere", "radius": 1e20}])", "sphere 0 has radius 1e+20"},
        {R"("colliders": [{"shape": "box", "scale": [1, -1, 1]}])",
         "/dust/colliders/0/scale/1: colliders: box 0 has a scale.y of -1; right is above 0"},
        {R"("cannon": [{"range": 1e20}])",
         "/dust/cannon/0/range: cannon: ball 0 has a range of 1e+20; right is above 0, to 1.8e19"},
        {R"("cannon": [{"forward": [0, 0, 0]}])", "/dust/cannon/0/forward: cannon: ball 0 has no direction"},
        {R"("controller": [{"frame": 5}, {"frame": 5}])", "keyframe 1 is of frame 5; right is after 5"},
        {R"("controller": [{"forward": [0, 0, 1]}, {"frame": 9, "forward": [0, 0, -2]}])",
         "keyframes 0 and 1 face opposite ways; right is one between them"},
        {R"("count": 2.5)", "/dust/count: 2.5 is not an integer from 1 to 4194240"},
        {R"("tools": [{"from": 0, "to": 5}])", R"(/dust/tools/0: the key "tool" is missing)"},
        {R"("tools": [{"tool": "wind", "from": -5}])", "/dust/tools/0/from: -5 is not an integer from 0"},
        {R"("tools": [{"tool": "emit", "distance": -2}])",
         "/dust/tools/0/distance: tools: 0 has a distance of -2; right is 0 to 1.8e19"},
        {R"("controller": [{"forward": [0, 1]}])", "/dust/controller/0/forward: [0,1] is not a vector of three"},
        {R"("controller": [{"frame": -3}])", "/dust/controller/0/frame: -3 is not an integer from 0"},
        {R"("controller": [{"frame": 5}, {"frame": 2}])", "keyframe 1 is of frame 2; right is after 5"},
        {R"("controller": [{"up": [0, 1, 0]}])", R"(/dust/controller/0: unknown key "up"; the keys here are frame)"},
        {R"("colliders": [{"shape": "capsule"}])", R"(/dust/colliders/0/shape: "capsule" is not one of sphere, box)"},
        {R"("colliders": [{"radius": 3}])", R"(/dust/colliders/0: the key "shape" is missing)"},
        {R"("colliders": [{"shape": "sphere", "scale": [1, 1, 1]}])",
         R"(unknown key "scale"; the keys here are shape)"},
        {R"("colliders": [{"shape": "box", "removed": 2}])", "/dust/colliders/0/removed: 2 is not an integer"},
        {R"("colliders": {})", "/dust/colliders: {} is not an array"},
        {R"("cannon": [{"frame": -2}])", "/dust/cannon/0/frame: -2 is not an integer from 0"},
        {R"("cannon": [{"mass": 3}])", R"(/dust/cannon/0: unknown key "mass"; the keys here are frame, position)"},
        {R"("colours": [[0, 0, 0]])", "/dust/colours: 1 element; right is two colours"},
        {R"("spawn": {"min": [0, 0, 0]})", R"(/dust/spawn: the key "max" is missing)"},
        {R"("world": {"min": [0, 0, 0], "max": [1, 1e39, 1]})",
         "/dust/world/max/1: 1e+39 is beyond what a float holds"},
    };
    for (const auto& [inside, words] : wrong) {
        const std::string error = error_of(of_dust(inside));
        INFO(inside << "\n" << error);
        CHECK_THAT(error, Catch::Contains(words) && Catch::StartsWith("scene.json"));
        CHECK(error.find('\n') == std::string::npos);
    }
    const auto of_constants = [](const std::string& inside) {
        return R"({"system": "dust", "constants": {)" + inside + R"(}, "dust": {"cannon": [{}]}})";
    };
    CHECK_THAT(error_of(of_constants(R"("tick": -1)")), Catch::Contains("tick is -1 s; right is 0 or above"));
    CHECK_THAT(error_of(of_constants(R"("timescale": 2)")), Catch::Contains("timescale is 2; right is 0 to 1"));
    CHECK_THAT(error_of(of_constants(R"("tick": 1e-7)")), Catch::Contains("right is 0 or at least 1e-05 s"));
    CHECK_THROWS_WITH(dust::load_scene(folder + "obb.json", {.particles = 4'194'241}),
                      Catch::Contains("count is 4194241; right is 1 to 4194240, 65535 groups of 64"));
    CHECK_THAT(error_of(R"({"system": "dust", "switches": {"suction": "hard"}, "dust": {}})"),
               Catch::Contains("/switches/suction"));
    CHECK_THAT(error_of(R"({"system": "dusk", "dust": {}})"), Catch::Contains("/system"));
    CHECK_THAT(error_of(R"({"system": "dust", "switches": {"box_detect": "rounded"}, "dust": {}})"),
               Catch::Contains("box_detect rounded goes with box_kind aabb; right for obb is boxed"));
    CHECK_THROWS_WITH(dust::load_scene(folder + "obb.json", {.set = {"one_hit=maybe"}}),
                      "--set one_hit: 'maybe' is not one of off, on");
    CHECK_THROWS_WITH(dust::load_scene(folder + "obb.json", {.set = {"two_hits=on"}}),
                      Catch::Contains("there is no switch 'two_hits' of dust"));
}

TEST_CASE("dust scenes: numbers that are not finite are refused of a host that is no file, too") {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
    const auto error_of = [](const std::function<void(dust::Settings&)>& change) -> std::string {
        dust::Settings s;
        s.tools.resize(1);
        s.colliders = {{}, {.sphere = false}};
        s.cannon.resize(1);
        dust::check(s);
        change(s);
        try {
            dust::check(s);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    for (const float bad : {nan, infinite, -infinite}) {
        const std::function<void(dust::Settings&)> changes[] = {
            [&](auto& s) { s.mass = bad; },
            [&](auto& s) { s.tick = bad; },
            [&](auto& s) { s.timescale = bad; },
            [&](auto& s) { s.air_resistance = bad; },
            [&](auto& s) { s.scale = bad; },
            [&](auto& s) { s.elasticity = bad; },
            [&](auto& s) { s.gravity.y = bad; },
            [&](auto& s) { s.colour_b.x = bad; },
            [&](auto& s) { s.switches.radius_of_scale = bad; },
            [&](auto& s) { s.spawn.max.y = bad; },
            [&](auto& s) { s.world.min.z = bad; },
            [&](auto& s) { s.controller[0].position.x = bad; },
            [&](auto& s) { s.controller[0].forward.x = bad; },
            [&](auto& s) { s.tools[0].force = bad; },
            [&](auto& s) { s.tools[0].range = bad; },
            [&](auto& s) { s.tools[0].angle = bad; },
            [&](auto& s) { s.tools[0].death_range = bad; },
            [&](auto& s) { s.tools[0].distance = bad; },
            [&](auto& s) { s.colliders[0].position.x = bad; },
            [&](auto& s) { s.colliders[0].radius = bad; },
            [&](auto& s) { s.colliders[1].scale.z = bad; },
            [&](auto& s) { s.colliders[1].rotate.y = bad; },
            [&](auto& s) { s.cannon[0].position.y = bad; },
            [&](auto& s) { s.cannon[0].forward.y = bad; },
            [&](auto& s) { s.cannon[0].speed = bad; },
            [&](auto& s) { s.cannon[0].range = bad; },
            [&](auto& s) { s.cannon[0].force = bad; },
        };
        for (std::size_t k = 0; k < std::size(changes); ++k) {
            const std::string error = error_of(changes[k]);
            INFO("number " << k << " of " << bad << ": " << error);
            CHECK_THAT(error, Catch::StartsWith("dust: "));
            CHECK(error.find('\n') == std::string::npos);
        }
    }
}

TEST_CASE("dust scenes: huge numbers run, overflow as they must, and both sides agree") {
    if (!gl())
        return skip(gl().missing());
    const auto with = [](const std::function<void(dust::Settings&)>& change) {
        dust::Settings s = scene("vacuum_and_back", "exact");
        s.count = 500;
        s.tools[0].to = 10;
        s.tools[1].from = 10;
        change(s);
        return run_dust(s, 30);
    };
    const CheckReport reports[] = {
        with([](auto& s) { s.tools[0].force = s.tools[1].force = 1.8e19F; }),
        with([](auto& s) { s.gravity.y = -3e38F; }),
        with([](auto& s) { s.tick = 1e30F; }),
        with([](auto& s) { s.air_resistance = 3e38F; }),
        with([](auto& s) { s.mass = 1e-38F; }),
        with([](auto& s) { s.scale = 1e30F; }),
        with([](auto& s) {
            s.world = {glm::vec3(0.0F), glm::vec3(0.01F)};
        }), // thinner than a grain
        with([](auto& s) { s.colliders[0].radius = 1.8e19F; }),
        with([](auto& s) { s.tools[1].to = std::numeric_limits<int>::max(); }),
    };
    for (const CheckReport& report : reports) {
        INFO(report_text(report, {}));
        CHECK(report.verdict == Verdict::agree);
    }
}

} // namespace lockstep::test::scenes_test
