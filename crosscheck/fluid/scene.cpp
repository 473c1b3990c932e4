#include "crosscheck/fluid/scene.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/scene/scene_emitters.hpp"
#include "crosscheck/scene/scene_fields.hpp"
#include "crosscheck/scene/scene_obstacles.hpp"
#include "reference/model/error.hpp"

namespace lockstep::fluid {
namespace {

/// The numbers among the switches, by name.
template <class Visit> void for_each_number(ShadingNumbers& numbers, const Visit& visit) {
    visit("thickness_floor", numbers.thickness_floor);
    visit("fresnel_power", numbers.fresnel_power);
    visit("fresnel_r0", numbers.fresnel_r0);
    visit("sky_bias", numbers.sky_bias);
}

const std::vector<std::string_view> number_names{"thickness_floor", "fresnel_power", "fresnel_r0", "sky_bias"};

void read_number(const JsonValue& json, float& value) { value = json.number(); }
void read_number(const JsonValue& json, int& value) { value = static_cast<int>(json.integer(1, 1023)); }

/// "name=value" of the command line; false where it is none of the numbers.
bool set_number(std::string_view setting, ShadingNumbers& numbers) {
    const std::size_t equals = std::min(setting.find('='), setting.size());
    const std::string_view name = setting.substr(0, equals),
                           text = setting.substr(std::min(equals + 1, setting.size()));
    bool found = false;
    for_each_number(numbers, [&](std::string_view one, auto& value) {
        if (one != name)
            return;
        found = true;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error == std::errc::result_out_of_range)
            throw Error(
                fmt::format("--set {}: {} is beyond what the number holds", name, plain_line(std::string(text))));
        if (error != std::errc() || end != text.data() + text.size())
            throw Error(
                fmt::format("--set {}: '{}' is not {}", name, plain_line(std::string(text)),
                            std::is_same_v<std::decay_t<decltype(value)>, int> ? "a whole number" : "a number"));
    });
    return found;
}

void read_switches_and_numbers(const JsonValue& json, const SceneOptions& options, Settings& settings) {
    std::vector<SwitchValue> switches = switch_values(settings.switches);
    if (const auto written = json.find("switches")) {
        read_values(*written, switches, number_names);
        for_each_number(settings.shading, [&](std::string_view name, auto& value) {
            if (const auto number = written->find(name))
                read_number(*number, value);
        });
    }
    for (const std::string& one : options.set)
        if (!set_number(one, settings.shading))
            set_value(one, "fluid", switches);
    take_values(settings.switches, switches);
}

void read_fluid(const JsonValue& json, Settings& settings) {
    json.check_keys({"radius", "filter_radius", "flow_iterations", "flow_step", "tick"});
    read_field(json, "radius", settings.radius);
    const auto within = [](int least, int most) {
        return [=](const JsonValue& v) { return static_cast<int>(v.integer(least, most)); };
    };
    read_field(json, "filter_radius", settings.filter_radius, within(0, most_filter_radius));
    read_field(json, "flow_iterations", settings.flow_iterations, within(1, most_flow_iterations));
    read_field(json, "flow_step", settings.flow_step);
    read_field(json, "tick", settings.tick);
}

Wave read_wave(const JsonValue& json) {
    json.check_keys({"amplitude", "length", "period"});
    Wave wave;
    read_field(json, "amplitude", wave.amplitude);
    read_field(json, "length", wave.length);
    read_field(json, "period", wave.period);
    return wave;
}

std::vector<glm::vec3> read_points(const JsonValue& json) {
    std::vector<glm::vec3> points;
    for (const JsonValue& one : json.items())
        points.push_back(one.vector());
    if (points.empty())
        json.fail(fmt::format("0 particles; right is 1 to {}", most_particles));
    return points;
}

std::vector<std::vector<glm::vec3>> read_recording(const JsonValue& json) {
    std::vector<std::vector<glm::vec3>> frames;
    for (const JsonValue& one : json.items()) {
        frames.push_back(read_points(one));
        if (frames.back().size() != frames.front().size())
            one.fail(fmt::format("frame {} has {}; right is {}, as frame 0 has", frames.size() - 1,
                                 counted(frames.back().size(), "particle"), frames.front().size()));
    }
    if (frames.empty())
        json.fail("0 frames; right is at least one");
    return frames;
}

/// Those that lie written in the file, frame by frame or once, or those of emitters.
void read_particles(const JsonValue& json, const SceneOptions& options, Settings& settings) {
    std::vector<std::string_view> given;
    for (const std::string_view key : {"particles", "recording", "emitters"})
        if (json.find(key))
            given.push_back(key);
    if (given.size() != 1)
        json.fail("a fluid has its particles by one of particles, recording, emitters");
    if (const auto recording = json.find("recording")) {
        settings.recording = read_recording(*recording);
        settings.particles = settings.recording.front();
    }
    if (const auto particles = json.find("particles"))
        settings.particles = read_points(*particles);
    const auto emitters_of = json.find("emitters");
    if (!emitters_of) {
        if (options.particles && *options.particles != settings.particles.size())
            json.find(given.front())
                ->fail(fmt::format("--particles {}: this scene lists its particles, {} in all, and a list has no other "
                                   "count; leave --particles out, or give emitters",
                                   *options.particles, settings.particles.size()));
        return;
    }
    for (const JsonValue& one : emitters_of->items())
        one.check_keys({"shape", "count", "min", "max", "thickness"});
    std::vector<Emitter> emitters = read_emitters(*emitters_of, most_particles);
    if (options.particles && *options.particles > most_particles)
        emitters_of->fail(fmt::format("{} particles; right is 1 to {}", *options.particles, most_particles));
    if (options.particles)
        scale_counts(emitters, *options.particles);
    settings.particles = std::move(emit(emitters, settings.seed).position);
}

} // namespace

Settings read_scene(const JsonValue& json, const SceneOptions& options) {
    json.check_keys({"description", "system", "seed", "preset", "switches", "camera", "render", "fluid", "wave",
                     "particles", "recording", "emitters", "obstacles"});
    static_cast<void>(json.at("system").choice({"fluid"}));
    Settings settings;
    read_field(json, "description", settings.description, [](const JsonValue& v) { return v.label(); });
    read_field(json, "seed", settings.seed,
               [](const JsonValue& v) { return static_cast<std::uint32_t>(v.integer(0, 0xffffffff)); });
    const std::string name = read_preset(json, options.preset);
    settings.switches = preset(name);
    settings.shading = shading_numbers(name);
    settings.arithmetic = name == "exact" ? ArithmeticSwitch::exact : ArithmeticSwitch::plain;
    if (const auto camera = json.find("camera"))
        settings.camera = read_camera(*camera, settings.camera);
    if (const auto render = json.find("render")) {
        const std::vector<JsonValue> two = elements(*render, 2, "its width and height");
        settings.width = static_cast<int>(two[0].integer(1, 8192));
        settings.height = static_cast<int>(two[1].integer(1, 8192));
    }
    if (const auto fluid = json.find("fluid"))
        read_fluid(*fluid, settings);
    if (const auto wave = json.find("wave"))
        settings.wave = read_wave(*wave);
    read_switches_and_numbers(json, options, settings);
    read_particles(json, options, settings);
    if (const auto obstacles = json.find("obstacles"))
        settings.obstacles = read_obstacles(*obstacles, std::nullopt);
    check_settings(json, settings);
    return settings;
}

Settings load_scene(const std::filesystem::path& file, const SceneOptions& options) {
    const nlohmann::json document = read_json(file);
    return read_scene(JsonValue(document, file.string()), options);
}

} // namespace lockstep::fluid
