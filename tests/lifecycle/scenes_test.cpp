#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "crosscheck/lifecycle/scene.hpp"
#include "reference/model/state_hash.hpp"
#include "tests/lifecycle/lifecycle_run.hpp"

namespace lockstep::test::scenes_test {

namespace lifecycle = lockstep::lifecycle;

namespace {

constexpr int frames = 60;
constexpr std::size_t capacity = 700;
const std::string folder = "data/scenes/lifecycle/";

std::vector<std::string> scenes() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".json")
            names.push_back(entry.path().stem());
    std::sort(names.begin(), names.end());
    return names;
}

lifecycle::Settings scene(const std::string& name, const std::string& preset) {
    return lifecycle::load_scene(folder + name + ".json", {.particles = capacity, .preset = preset});
}

std::string reference_hash(const std::string& name) {
    const System system = lifecycle::system(host_of(scene(name, "exact")));
    ReferenceRun run = reference_of(system);
    for (int frame = 0; frame < frames; ++frame)
        run.step(frame);
    return hash_text(run.hash());
}

std::map<std::string, std::string> golden() {
    std::ifstream stream("data/golden/lifecycle/exact.json");
    const nlohmann::json file = nlohmann::json::parse(stream);
    REQUIRE(file.at("frames") == frames);
    REQUIRE(file.at("capacity") == capacity);
    return file.at("hashes");
}

} // namespace

TEST_CASE("lifecycle scenes: each has its kept hash in preset exact") {
    const std::map<std::string, std::string> kept = golden();
    CHECK(scenes().size() == kept.size());
    for (const std::string& name : scenes()) {
        INFO(name);
        CHECK(reference_hash(name) == kept.at(name));
    }
}

TEST_CASE("lifecycle scenes: on its own way the GPU comes to the kept hash") {
    if (!gl())
        return skip(gl().missing());
    for (const std::string name : {"two_emitters", "replace_oldest", "one_particle", "all_die_at_once"}) {
        INFO(name);
        const CheckReport report = run_lifecycle(scene(name, "exact"), frames, CheckMode::free);
        CHECK(report.verdict == Verdict::agree);
        CHECK(hash_text(report.gpu_hash) == golden().at(name));
    }
}

/// All of them, both ways: lockstep_tests_lifecycle "[scenes]"
TEST_CASE("lifecycle scenes: no bit differs in any, in preset exact and corrected", "[.][scenes]") {
    if (!gl())
        return skip(gl().missing());
    for (const std::string& name : scenes())
        for (const char* const preset : {"corrected", "exact", "paper"}) {
            INFO(name << ", " << preset);
            lifecycle::Settings s = scene(name, preset);
            const bool ordered = s.switches.compaction == lifecycle::Compaction::scan;
            const CheckReport report = run_lifecycle(
                s, frames, ordered && s.arithmetic == ArithmeticSwitch::exact ? CheckMode::free : CheckMode::resync);
            CHECK((report.verdict == Verdict::agree || (!ordered && report.verdict == Verdict::legal)));
        }
}

/// Writes the hashes anew: lockstep_tests_lifecycle "[golden]"
TEST_CASE("lifecycle scenes: hashes to keep", "[.][golden]") {
    nlohmann::json file{{"frames", frames}, {"capacity", capacity}, {"hashes", nlohmann::json::object()}};
    for (const std::string& name : scenes())
        file["hashes"][name] = reference_hash(name);
    std::filesystem::create_directories("data/golden/lifecycle");
    std::ofstream("data/golden/lifecycle/exact.json") << file.dump(2) << "\n";
}

TEST_CASE("lifecycle scenes: the particles of all emitters are counted before one is made") {
    lifecycle::Settings settings;
    settings.emitters.resize(2);
    for (lifecycle::Emitter& emitter : settings.emitters)
        emitter.capacity = lifecycle::most_particles_of_emitter;
    CHECK_THROWS_WITH(lifecycle::Host(settings),
                      "emitter 1: 33553920 particles up to here; a scene has at most 16776960");
}

TEST_CASE("lifecycle scenes: the host's time does not grow with the square of the bursts") {
    lifecycle::Settings settings;
    settings.switches.overflow = lifecycle::Overflow::replace_oldest;
    lifecycle::Emitter& emitter = settings.emitters.front();
    emitter.capacity = 100;
    emitter.rate = 0.0;
    for (int frame = 0; frame < 500'000; ++frame)
        emitter.bursts.emplace_back(frame / 2, 3U);
    CHECK(lifecycle::Host(settings).slots() == 100 + 2 * 3 + 1);
}

TEST_CASE("lifecycle scenes: what is wrong with a file is said in one line, with its place") {
    const auto error_of = [](const std::string& emitter, const std::string& rest = "") -> std::string {
        const std::string text = R"({"system": "lifecycle", )" + rest + R"("emitters": [{)" + emitter + "}]}";
        try {
            const nlohmann::json document = parse_json(text, "scene.json");
            const lifecycle::Host host(lifecycle::read_scene(JsonValue(document, "scene.json")));
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    CHECK(error_of("") == "");
    CHECK(error_of(R"("direction_jitter": 2, "speed": 0, "color": [[2, 1, 1, 1], [1, 1, 1, 1]], "uv_scale": 0)") == "");
    const std::pair<const char*, const char*> wrong[] = {
        {R"("capacity": 0)", "/emitters/0/capacity"},
        {R"("capacity": 16776961)", "/emitters/0/capacity"},
        {R"("rate": -1)", "/emitters/0/rate"},
        {R"("rate": 1e38)", "rate is 1e+38"},
        {R"("rate": 1e400)", "scene.json"},
        {R"("bursts": [[0]])", "/emitters/0/bursts/0"},
        {R"("bursts": [[0, -1]])", "/emitters/0/bursts/0/1"},
        {R"("lifetime": [2, 1])", "/emitters/0/lifetime: emitter 0: lifetime is 2 to 1"},
        {R"("lifetime": [1])", "/emitters/0/lifetime"},
        {R"("direction": [0, 0, 0])", "direction has no length"},
        {R"("cone": 181)", "cone is 181 degrees"},
        {R"("shape": "box")", "min"},
        {R"("shape": "blob")", "/emitters/0/shape"},
        {R"("shape": "point", "radius": 2)", "is no property of a point"},
        {R"("path": [{"frame": 3}, {"frame": 3}])", "frame 3 after 3"},
        {R"("color": [[1, 1, 1]])", "/emitters/0/color"},
        {R"("forces": [{"type": "wind"}])", "/emitters/0/forces/0/type"},
        {R"("forces": [{"type": "vortex", "axis": [0, 0, 0]}])", "force 0: axis has no length"},
        {R"("forces": [{"type": "vortex", "radius": 0}])", "force 0: radius is 0"},
        {R"("forces": [{"type": "drag", "k": -1}])", "force 0: k is -1"},
        {R"("forces": [{"type": "drag", "radius": 1}])", "radius"},
        {R"("forces": [{"type": "curl_noise", "seed": 16777216}])", "seed"},
        {R"("colour": 3)", "colour"},
        {R"("shape": "box", "min": [0, 1, 0], "max": [0, 0, 0])", "/emitters/0: min is above max in y"},
        {R"("shape": "sphere", "radius": -1)", "/emitters/0/radius: -1 is not a number from 0 up"},
        {R"("direction_jitter": -1)", "/emitters/0/direction_jitter: -1 is not a number from 0 up"},
        {R"("speed": -1)", "/emitters/0/speed: -1 is not a number from 0 up"},
        {R"("speed_jitter": 2)", "/emitters/0/speed_jitter: 2 is not a fraction from 0 to 1"},
        {R"("size": [-1, 1])", "/emitters/0/size/0: -1 is not a number from 0 up"},
        {R"("lifetime": [-1, 1])", "/emitters/0/lifetime/0: -1 is not a number from 0 up"},
        {R"("forces": [{"type": "attraction", "softening": -1}])", "/forces/0/softening: -1 is not a number from 0 up"},
    };
    for (const auto& [inside, words] : wrong) {
        const std::string error = error_of(inside);
        INFO(inside << "\n" << error);
        CHECK_THAT(error, Catch::Contains(words) && Catch::StartsWith("scene.json"));
        CHECK(error.find('\n') == std::string::npos);
    }
    CHECK_THAT(error_of("", R"("switches": {"layout": "41"}, )"), Catch::Contains("/switches/layout"));
    CHECK_THAT(error_of("", R"("tick": 0, )"), Catch::Contains("/tick"));
    CHECK(error_of("", R"("switches": {"management": "index_lists"}, )") == "");
    CHECK_THAT(error_of("", R"("switches": {"management": "index_lists", "overflow": "replace_oldest"}, )"),
               Catch::Contains("right is drop_new"));
    CHECK_THAT(error_of(R"("draw": "ribbon")", R"("switches": {"management": "index_lists"}, )"),
               Catch::Contains("right is layout=112"));
    CHECK_THAT(error_of(R"("draw": "ribbon")", R"("switches": {"management": "index_lists", "layout": "112"}, )"),
               Catch::Contains("right is uv_anchor=oldest"));
    CHECK_THAT(error_of("", R"("switches": {"distance_sum": "float_blocks"}, )"), Catch::Contains("uv_anchor=oldest"));
    CHECK_THROWS_WITH(lifecycle::load_scene(folder + "fire.json", {.set = {"layout=41"}}),
                      Catch::Contains("layout: '41' is not one of 112, 80"));
    CHECK_THROWS_WITH(lifecycle::load_scene(folder + "fire.json", {.set = {"size=40"}}),
                      Catch::Contains("there is no switch 'size' of lifecycle"));
}

} // namespace lockstep::test::scenes_test
