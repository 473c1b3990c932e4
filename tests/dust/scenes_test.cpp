#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "crosscheck/dust/scene.hpp"
#include "reference/model/state_hash.hpp"
#include "tests/dust/one_grain.hpp"

using namespace lockstep;
using namespace lockstep::test;
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
        {R"("spawn": {"min": [5, 0, 0], "max": [0, 5, 5]})", "spawn: min.x is 5, above max, 0"},
        {R"("tools": [{"tool": "vacuum", "angle": 91}])", "angle of 91 degrees; right is 0.01 to 90"},
        {R"("tools": [{"tool": "broom"}])", "/dust/tools/0/tool"},
        {R"("tools": [{"tool": "emit", "from": 9, "to": 3}])", "is on from 9 to 3"},
        {R"("colliders": [{"shape": "sphere", "radius": 0}])", "sphere 0 has radius 0"},
        {R"("colliders": [{"shape": "box", "scale": [1, 0, 1]}])", "box 0 has scale 1 0 1"},
        {R"("controller": [])", "there is no keyframe"},
        {R"("controller": [{"forward": [0, 0, 0]}])", "keyframe 0: forward has no length"},
        {R"("colour": 3)", "colour"},
    };
    for (const auto& [inside, words] : wrong) {
        const std::string error = error_of(of_dust(inside));
        INFO(inside << "\n" << error);
        CHECK_THAT(error, Catch::Contains(words) && Catch::StartsWith("scene.json"));
        CHECK(error.find('\n') == std::string::npos);
    }
    CHECK_THAT(error_of(R"({"system": "dust", "switches": {"suction": "hard"}, "dust": {}})"),
               Catch::Contains("/switches/suction"));
    CHECK_THAT(error_of(R"({"system": "dusk", "dust": {}})"), Catch::Contains("/system"));
    CHECK_THROWS_WITH(dust::load_scene(folder + "obb.json", {.set = {"one_hit=maybe"}}),
                      "one_hit: 'maybe' is not one of off, on");
    CHECK_THROWS_WITH(dust::load_scene(folder + "obb.json", {.set = {"two_hits=on"}}),
                      Catch::Contains("there is no switch 'two_hits' of dust"));
}
