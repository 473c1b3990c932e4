#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "crosscheck/fluid/scene.hpp"
#include "reference/model/state_hash.hpp"
#include "tests/fluid/fluid_run.hpp"

namespace lockstep::test::scenes_test {

namespace fluid = lockstep::fluid;

namespace {

constexpr int frames = 2;
constexpr std::size_t count = 512;
const std::string folder = "data/scenes/fluid/";

std::vector<std::string> scenes() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".json")
            names.push_back(entry.path().stem());
    std::sort(names.begin(), names.end());
    return names;
}

/// With few particles, larger for that, and a small image: of the benchmark as of the others.
fluid::Settings scene(const std::string& name, const std::string& preset) {
    const std::string file = folder + name + ".json";
    fluid::Settings s = fluid::load_scene(file, {.preset = preset});
    if (s.particles.size() > count) {
        s = fluid::load_scene(file, {.particles = count, .preset = preset});
        s.radius *= 3.0F;
    }
    s.width = 64;
    s.height = 48;
    s.filter_radius = 4;
    return s;
}

std::string reference_hash(const fluid::Settings& settings) {
    const System system = fluid::system(host_of(settings));
    ReferenceRun run(system, named_profile("strict"));
    for (int frame = 0; frame < frames; ++frame)
        run.step(frame);
    return hash_text(run.hash());
}

std::map<std::string, std::string> golden() {
    std::ifstream stream("data/golden/fluid/exact.json");
    const nlohmann::json file = nlohmann::json::parse(stream);
    REQUIRE(file.at("frames") == frames);
    REQUIRE(file.at("particles") == count);
    return file.at("hashes");
}

} // namespace

TEST_CASE("fluid scenes: each has its kept hash in preset exact") {
    const std::map<std::string, std::string> kept = golden();
    const std::vector<std::string> all = scenes();
    CHECK(all.size() == kept.size());
    for (const std::string& name : all) {
        INFO(name);
        REQUIRE(kept.contains(name));
        CHECK(reference_hash(scene(name, "exact")) == kept.at(name));
    }
}

TEST_CASE("fluid scenes: both sides have the kept hash of the waves and of the recording") {
    if (!gl())
        return skip(gl().missing());
    for (const std::string name : {"wave", "recorded"}) {
        const CheckReport report = run_fluid(scene(name, "exact"), frames, CheckMode::free);
        INFO(name);
        CHECK(report.verdict == Verdict::agree);
        CHECK(hash_text(report.gpu_hash) == golden().at(name));
    }
}

TEST_CASE("fluid scenes: too many particles are refused before one is made") {
    nlohmann::json scene = read_json(folder + "wave.json");
    nlohmann::json emitter{{"shape", "box"}, {"count", 2'000'000}, {"min", {0, 0, 0}}, {"max", {1, 1, 1}}};
    scene.erase("particles");
    scene["emitters"] = std::vector(49, emitter); // 3 GB
    CHECK_THROWS_WITH(fluid::read_scene(JsonValue(scene, "x.json")),
                      "x.json: /emitters/1: 4000000 particles up to here; a scene has at most 2097152");
    scene["emitters"] = std::vector(1, emitter);
    CHECK_THROWS_WITH(fluid::read_scene(JsonValue(scene, "x.json"), {.particles = 100'000'000}),
                      "x.json: /emitters: 100000000 particles; right is 1 to 2097152");
}

TEST_CASE("fluid scenes: what is wrong in a scene is one line that names the place") {
    const nlohmann::json right = read_json(folder + "wave.json");
    const auto told = [&](const std::string& pointer, const nlohmann::json& wrong, const SceneOptions& options = {}) {
        nlohmann::json changed = right;
        changed[nlohmann::json::json_pointer(pointer)] = wrong;
        try {
            static_cast<void>(fluid::read_scene(JsonValue(changed, "x.json"), options));
            return std::string("nothing");
        } catch (const Error& error) {
            return std::string(error.what());
        }
    };
    const auto told_of = [&](const std::string& set) { return told("/seed", 1, {.set = {set}}); };
    using Catch::Contains;
    CHECK(told("/seed", 4) == "nothing");
    CHECK_THAT(told("/fluid/radius", 0), Contains("radius is 0 m; right is above 0"));
    CHECK_THAT(told("/fluid/radius", 1e-40), Contains("right is above 0.000001, to 1000"));
    CHECK_THAT(told("/fluid/radius", 1e20), Contains("right is above 0.000001, to 1000"));
    CHECK_THAT(told("/fluid/radius", "x"), Contains("/fluid/radius"));
    CHECK_THAT(told("/fluid/filter_radius", 32), Contains("/fluid/filter_radius: 32 is not an integer from 0 to 31"));
    CHECK_THAT(told("/fluid/flow_iterations", 2000000), Contains("2000000 is not an integer from 1 to 1000"));
    CHECK_THAT(told("/fluid/rest_density", 1000), Contains("rest_density"));
    CHECK_THAT(told("/wave/period", 0), Contains("wave: period is 0 s; right is above 0"));
    CHECK_THAT(told("/render", nlohmann::json::array({800})), Contains("right is its width and height"));
    CHECK_THAT(told("/camera/near", 200), Contains("near"));
    CHECK_THAT(told("/emitters/0/speed", 1), Contains("speed"));
    CHECK_THAT(told("/particles", nlohmann::json::parse("[[0, 0, 0]]")),
               Contains("by one of particles, recording, emitters"));
    CHECK_THAT(told("/switches", {{"filter", "median"}}), Contains("/switches/filter"));
    CHECK_THAT(told("/obstacles/0/shape", "ring"), Contains("/obstacles/0/shape"));
    CHECK_THAT(told_of("filter=median"), Contains("'median' is not one of off, gaussian"));
    CHECK_THAT(told_of("fresnel_power=fifty"), Contains("fresnel_power: 'fifty' is not a whole number"));
    CHECK_THAT(told_of("fresnel_power=1024"), Contains("fresnel_power is 1024; right is 1 to 1023"));
    CHECK_THAT(told_of("unproject=as_ndc"), Contains("unproject as_ndc goes with depth_value ndc or window"));
    CHECK_THAT(told_of("depth_format=d24"), Contains("it goes with depth_value ndc or window"));
    CHECK_THAT(told("/fluid/flow_step", 0.01, {.set = {"filter=curvature_flow"}}),
               Contains("curvature flow is unstable"));
    CHECK(told("/fluid/flow_step", 0.0001, {.set = {"filter=curvature_flow"}}) == "nothing");
    nlohmann::json both = read_json(folder + "recorded.json");
    both["wave"] = {{"amplitude", 0.1}};
    CHECK_THROWS_WITH(fluid::read_scene(JsonValue(both, "x.json")),
                      Contains("wave and recording: right is one of them"));
    both.erase("wave");
    both["recording"][1].erase(0);
    CHECK_THROWS_WITH(fluid::read_scene(JsonValue(both, "x.json")),
                      Contains("x.json: /recording/1: frame 1 has 15 particles; right is 16, as frame 0 has"));
    both["recording"][1].clear();
    CHECK_THROWS_WITH(fluid::read_scene(JsonValue(both, "x.json")),
                      Contains("x.json: /recording/1: 0 particles; right is 1 to 2097152"));
    both["recording"].clear();
    CHECK_THROWS_WITH(fluid::read_scene(JsonValue(both, "x.json")),
                      Contains("x.json: /recording: 0 frames; right is at least one"));
}

/// Writes the kept hashes anew: lockstep_tests_fluid "[golden]"
TEST_CASE("fluid scenes: the kept hashes, made anew", "[.][golden]") {
    nlohmann::json file{{"frames", frames}, {"particles", count}, {"hashes", nlohmann::json::object()}};
    for (const std::string& name : scenes())
        file["hashes"][name] = reference_hash(scene(name, "exact"));
    std::filesystem::create_directories("data/golden/fluid");
    std::ofstream("data/golden/fluid/exact.json") << file.dump(2) << "\n";
}

} // namespace lockstep::test::scenes_test
