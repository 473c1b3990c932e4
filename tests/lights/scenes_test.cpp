#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "crosscheck/lights/scene.hpp"
#include "reference/model/state_hash.hpp"
#include "tests/lights/lights_run.hpp"

namespace lockstep::test::scenes_test {

namespace lights = lockstep::lights;

namespace {

constexpr int frames = 3;
constexpr std::size_t count = 256;
const std::string folder = "data/scenes/lights/";

std::vector<std::string> scenes() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".json")
            names.push_back(entry.path().stem());
    std::sort(names.begin(), names.end());
    return names;
}

/// With few lights and a small image: of the benchmark as of the others.
lights::Settings scene(const std::string& name, const std::string& preset) {
    const std::string file = folder + name + ".json";
    const auto written = lights::load_scene(file).lights.size();
    lights::Settings s = lights::load_scene(file, {.particles = std::min(count, written), .preset = preset, .set = {}});
    s.width = 64;
    s.height = 36;
    if (name == "crowd" || name == "hall" || name == "swarms")
        s.grid = {.size = {32, 8, 32}, .voxel = 4.0F, .origin = {-64.0F, 0.0F, -64.0F}};
    return s;
}

std::string reference_hash(const lights::Settings& settings) {
    const System system = lights::system(host_of(settings));
    ReferenceRun run(system, named_profile("strict"));
    for (int frame = 0; frame < frames; ++frame)
        run.step(frame);
    return hash_text(run.hash());
}

std::map<std::string, std::string> golden() {
    std::ifstream stream("data/golden/lights/exact.json");
    const nlohmann::json file = nlohmann::json::parse(stream);
    REQUIRE(file.at("frames") == frames);
    REQUIRE(file.at("lights") == count);
    return file.at("hashes");
}

} // namespace

TEST_CASE("lights scenes: each has its kept hash in preset exact") {
    const std::map<std::string, std::string> kept = golden();
    const std::vector<std::string> all = scenes();
    CHECK(all.size() == kept.size());
    for (const std::string& name : all) {
        INFO(name);
        REQUIRE(kept.contains(name));
        CHECK(reference_hash(scene(name, "exact")) == kept.at(name));
    }
}

TEST_CASE("lights scenes: both sides have the kept hash of the hall") {
    if (!gl())
        return skip(gl().missing());
    const CheckReport report = run_lights(scene("hall", "exact"), frames, CheckMode::free);
    CHECK(report.verdict == Verdict::agree);
    CHECK(hash_text(report.gpu_hash) == golden().at("hall"));
}

TEST_CASE("lights scenes: too many lights are refused before one is made") {
    nlohmann::json scene = read_json(folder + "one_light.json");
    nlohmann::json group = scene["lights"][0];
    group["count"] = lights::most_lights;
    scene["lights"] = std::vector(1000, group); // 98 GB
    CHECK_THROWS_WITH(lights::read_scene(JsonValue(scene, "x.json")),
                      "x.json: /lights: 2097152000 lights; right is 1 to 2097152");
    scene["lights"] = std::vector(1, group);
    CHECK_THROWS_WITH(lights::read_scene(JsonValue(scene, "x.json"), {.particles = 100'000'000}),
                      "x.json: /lights: 100000000 lights; right is 1 to 2097152");
}

TEST_CASE("lights scenes: what is wrong in a scene is one line that names the place") {
    const nlohmann::json right = read_json(folder + "one_light.json");
    const auto told = [&](const std::string& pointer, const nlohmann::json& wrong) {
        nlohmann::json changed = right;
        changed[nlohmann::json::json_pointer(pointer)] = wrong;
        try {
            static_cast<void>(lights::read_scene(JsonValue(changed, "x.json")));
            return std::string("nothing");
        } catch (const Error& error) {
            return std::string(error.what());
        }
    };
    using Catch::Contains;
    CHECK_THAT(told("/grid/size", {15, 8, 16}),
               Contains("/grid/size/0: grid: size.x is 15 voxels; right is a power of two, 2 to 256"));
    CHECK_THAT(told("/grid/size", {16, 0, 16}), Contains("/grid/size/1: 0 is not an integer from 2 to 256"));
    CHECK_THAT(told("/grid/size", {16, 8, 4096}), Contains("/grid/size/2: 4096 is not an integer from 2 to 256"));
    CHECK_THAT(told("/grid/voxel", 0),
               Contains("/grid/voxel: grid: a voxel of 0 m; right is a power of two, 0.25 to 4"));
    CHECK_THAT(told("/grid/voxel", 0.75), Contains("a voxel of 0.75 m; right is a power of two, 0.25 to 4"));
    CHECK_THAT(told("/grid/origin", {0.5, 0, 0}),
               Contains("/grid/origin/0: grid: origin.x is 0.5 m; right is a multiple of a voxel, 1 m"));
    CHECK_THAT(told("/lights/0/range", 15), Contains("a range of 15 m; right is up to 14 voxels, 14 m"));
    CHECK_THAT(told("/lights/0/range", 0), Contains("a range of 0 m; right is above 0"));
    CHECK_THAT(told("/lights/0/range", 1e-30), Contains("right is above 0.000001"));
    const nlohmann::json crowd = read_json(folder + "crowd.json")["lights"][0];
    nlohmann::json turned = crowd;
    turned["min"] = {1000, 0, 0};
    CHECK_THAT(told("/lights/0", crowd), !Contains("min is above max"));
    CHECK_THAT(told("/lights/0", turned), Contains("min is above max in x"));
    CHECK_THAT(told("/obstacles/0/albedo", {0.3, 0.5, 0.5}), Contains("three multiples of 1/256, below 1"));
    CHECK_THAT(told("/obstacles/0/albedo", {1, 0.5, 0.5}), Contains("three multiples of 1/256, below 1"));
    CHECK_THAT(told("/switches/shading", "directional"), Contains("/switches/shading"));
    CHECK_THAT(told("/lights/0/shape", "ring"), Contains("/lights/0/shape"));
    CHECK_THAT(told("/lights/0/direction_jitter", -0.1),
               Contains("/direction_jitter: -0.1 is not a fraction from 0 to 1"));
    CHECK_THAT(told("/lights/0/speed", -1), Contains("/lights/0/speed: -1 is not a number from 0 up"));
    CHECK_THAT(told("/lights/0/intensity", -1), Contains("/lights/0/intensity: -1 is not a number from 0 up"));
    CHECK_THAT(told("/lights/0/palette", nlohmann::json::parse("[[1, -1, 1]]")),
               Contains("/lights/0/palette/0/1: -1 is not a number from 0 up"));
    CHECK(told("/lights/0/intensity", 1e30) == "nothing");
    for (const char* const accumulate : {"fixed64", "fixed32"}) {
        nlohmann::json summed = right;
        summed["switches"]["accumulate"] = accumulate;
        summed["lights"][0]["intensity"] = 1e9;
        CHECK_NOTHROW(lights::read_scene(JsonValue(summed, "x.json")));
        summed["lights"][0]["intensity"] = 1e30;
        CHECK_THROWS_WITH(lights::read_scene(JsonValue(summed, "x.json")),
                          Contains("x.json: /lights: lights: their sums are beyond") &&
                              Contains("right is below 2^31"));
    }
    CHECK(told("/seed", 4) == "nothing");
}

/// Writes the kept hashes anew: lockstep_tests_lights "[golden]"
TEST_CASE("lights scenes: the kept hashes, made anew", "[.][golden]") {
    nlohmann::json file{{"frames", frames}, {"lights", count}, {"hashes", nlohmann::json::object()}};
    for (const std::string& name : scenes())
        file["hashes"][name] = reference_hash(scene(name, "exact"));
    std::ofstream("data/golden/lights/exact.json") << file.dump(2) << "\n";
}

} // namespace lockstep::test::scenes_test
