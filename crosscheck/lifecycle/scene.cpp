#include "crosscheck/lifecycle/scene.hpp"

#include <algorithm>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "crosscheck/files/plain_text.hpp"
#include "reference/model/error.hpp"

namespace lockstep::lifecycle {
namespace {

constexpr std::int64_t last_frame = 1'000'000;

template <class Value, class Read> void read(const JsonValue& json, std::string_view key, Value& value, Read how) {
    if (const auto found = json.find(key))
        value = how(*found);
}
void read(const JsonValue& json, std::string_view key, float& value) {
    read(json, key, value, [](const JsonValue& v) { return v.number(); });
}
void read(const JsonValue& json, std::string_view key, glm::vec3& value) {
    read(json, key, value, [](const JsonValue& v) { return v.vector(); });
}
void read(const JsonValue& json, std::string_view key, std::array<float, 2>& value) {
    read(json, key, value, [](const JsonValue& v) {
        const std::vector<JsonValue> two = v.items();
        if (two.size() != 2)
            v.fail(fmt::format("{} numbers; right is two", two.size()));
        return std::array{two[0].number(), two[1].number()};
    });
}

int frame_of(const JsonValue& json) { return static_cast<int>(json.integer(0, last_frame)); }

glm::vec4 read_color(const JsonValue& json) {
    const std::vector<JsonValue> four = json.items();
    if (four.size() != 4)
        json.fail(fmt::format("{} numbers; right is red, green, blue and opacity", four.size()));
    return {four[0].number(), four[1].number(), four[2].number(), four[3].number()};
}

Force read_force(const JsonValue& json) {
    Force force;
    force.kind = static_cast<Force::Kind>(json.at("type").choice({"drag", "vortex", "attraction", "curl_noise"}));
    switch (force.kind) {
    case Force::Kind::drag:
        json.check_keys({"type", "k"});
        read(json, "k", force.k);
        break;
    case Force::Kind::vortex:
        json.check_keys({"type", "centre", "axis", "strength", "radius", "falloff", "pull"});
        break;
    case Force::Kind::attraction:
        json.check_keys({"type", "centre", "strength", "radius", "falloff", "law", "softening", "kill_radius"});
        read(json, "law", force.inverse_square, [](const JsonValue& v) {
            return v.choice({"linear", "inverse_square"}) == 1;
        });
        break;
    case Force::Kind::curl_noise:
        json.check_keys({"type", "strength", "frequency", "pan", "seed"});
        break;
    }
    read(json, "centre", force.centre);
    read(json, "axis", force.axis);
    read(json, "strength", force.strength);
    read(json, "radius", force.radius);
    read(json, "falloff", force.falloff, [](const JsonValue& v) { return static_cast<int>(v.integer(0, 2)); });
    read(json, "pull", force.pull);
    read(json, "softening", force.softening);
    read(json, "kill_radius", force.kill_radius);
    read(json, "frequency", force.frequency);
    read(json, "pan", force.pan);
    read(json, "seed", force.seed,
         [](const JsonValue& v) { return static_cast<std::uint32_t>(v.integer(0, (1 << 24) - 1)); });
    return force;
}

Place read_place(const JsonValue& json) {
    json.check_keys({"frame", "position"});
    Place place;
    read(json, "frame", place.frame, frame_of);
    read(json, "position", place.position);
    return place;
}

void read_shape(const JsonValue& json, Emitter& e) {
    read(json, "shape", e.shape, [](const JsonValue& v) {
        return static_cast<Emitter::Shape>(v.choice({"point", "box", "sphere"}));
    });
    const char* const place = e.shape == Emitter::Shape::point ? "position" : "centre";
    const auto refuse = [&](std::string_view key) {
        if (const auto found = json.find(key))
            found->fail(fmt::format("is no property of a {}", e.shape == Emitter::Shape::point ? "point"
                                                              : e.shape == Emitter::Shape::box ? "box"
                                                                                               : "sphere"));
    };
    if (e.shape == Emitter::Shape::box) {
        e.min = json.at("min").vector();
        e.max = json.at("max").vector();
        refuse("position");
        refuse("centre");
        refuse("radius");
        return;
    }
    read(json, place, e.min);
    e.max = e.min;
    read(json, "radius", e.radius);
    refuse("min");
    refuse("max");
    refuse(e.shape == Emitter::Shape::point ? "radius" : "position");
}

Emitter read_emitter(const JsonValue& json) {
    json.check_keys(
        {"capacity", "rate", "bursts",    "lifetime",         "shape", "position",     "centre", "min",          "max",
         "radius",   "path", "direction", "direction_jitter", "speed", "speed_jitter", "cone",   "acceleration", "size",
         "color",    "draw", "uv",        "uv_scale",         "forces"});
    Emitter e;
    read(json, "capacity", e.capacity, [](const JsonValue& v) {
        return static_cast<std::size_t>(v.integer(1, static_cast<std::int64_t>(most_particles_of_emitter)));
    });
    read(json, "rate", e.rate, [](const JsonValue& v) { return double{v.number(number::not_negative)}; });
    if (const auto bursts = json.find("bursts"))
        for (const JsonValue& burst : bursts->items()) {
            const std::vector<JsonValue> two = burst.items();
            if (two.size() != 2)
                burst.fail("is not a frame and a count");
            e.bursts.emplace_back(frame_of(two[0]), static_cast<std::uint32_t>(two[1].integer(0, 1 << 24)));
        }
    read(json, "lifetime", e.lifetime);
    read_shape(json, e);
    if (const auto path = json.find("path"))
        for (const JsonValue& place : path->items())
            e.path.push_back(read_place(place));
    read(json, "direction", e.direction);
    read(json, "direction_jitter", e.direction_jitter);
    read(json, "speed", e.speed);
    read(json, "speed_jitter", e.speed_jitter);
    read(json, "cone", e.cone, [](const JsonValue& v) { return v.number(number::not_negative); });
    read(json, "acceleration", e.acceleration);
    read(json, "size", e.size);
    if (const auto color = json.find("color")) {
        const std::vector<JsonValue> two = color->items();
        if (two.size() != 2)
            color->fail("is not two colours, the first and the last");
        e.color = {read_color(two[0]), read_color(two[1])};
    }
    read(json, "draw", e.draw, [](const JsonValue& v) {
        return static_cast<Emitter::Draw>(v.choice({"sprite", "ribbon"}));
    });
    read(json, "uv", e.uv, [](const JsonValue& v) {
        return static_cast<Emitter::Uv>(v.choice({"segment", "stretched", "distance"}));
    });
    read(json, "uv_scale", e.uv_scale);
    if (const auto forces = json.find("forces"))
        for (const JsonValue& force : forces->items())
            e.forces.push_back(read_force(force));
    return e;
}

void read_camera(const JsonValue& json, Camera& camera) {
    json.check_keys({"eye", "target", "up", "fov_y", "near", "far"});
    read(json, "eye", camera.eye);
    read(json, "target", camera.target);
    read(json, "up", camera.up);
    read(json, "fov_y", camera.fov_y);
    read(json, "near", camera.near_plane);
    read(json, "far", camera.far_plane);
    if (!(glm::length(glm::cross(camera.target - camera.eye, camera.up)) > 0.0F))
        json.fail("looks nowhere: target is eye, or up points along the view");
    if (!(camera.near_plane > 0.0F && camera.far_plane > camera.near_plane))
        json.fail("near and far are no planes before it; right is 0 < near < far");
    if (!(camera.fov_y > 0.0F && camera.fov_y < 180.0F))
        json.fail("fov_y is not between 0 and 180 degrees");
}

void read_switches(const JsonValue& json, Switches& switches) {
    std::vector<std::string_view> known;
    for_each_switch(switches, [&](std::string_view name, auto&, const auto&) { known.push_back(name); });
    json.check_keys(known);
    for_each_switch(switches, [&](std::string_view name, auto& value, const std::vector<std::string_view>& names) {
        if (const auto found = json.find(name))
            value = static_cast<std::decay_t<decltype(value)>>(found->choice(names));
    });
}

void set_switch(const std::string& text, Switches& switches) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals), word = equals == text.npos ? "" : text.substr(equals + 1);
    bool known = false;
    std::vector<std::string_view> all;
    for_each_switch(switches, [&](std::string_view one, auto& value, const std::vector<std::string_view>& names) {
        all.push_back(one);
        if (one != name)
            return;
        known = true;
        const auto found = std::find(names.begin(), names.end(), word);
        if (found == names.end())
            throw Error(fmt::format("{}: '{}' is not one of {}", name, plain_line(word), fmt::join(names, ", ")));
        value = static_cast<std::decay_t<decltype(value)>>(found - names.begin());
    });
    if (!known)
        throw Error(
            fmt::format("there is no switch '{}' of lifecycle; there are {}", plain_line(name), fmt::join(all, ", ")));
}

} // namespace

Settings read_scene(const JsonValue& json, const SceneOptions& options) {
    json.check_keys({"description", "system", "seed", "preset", "tick", "switches", "box", "camera", "emitters"});
    static_cast<void>(json.at("system").choice({"lifecycle"}));
    Settings settings;
    read(json, "description", settings.description, [](const JsonValue& v) { return v.label(); });
    read(json, "seed", settings.seed,
         [](const JsonValue& v) { return static_cast<std::uint64_t>(v.integer(0, std::int64_t{0xffffffff})); });
    read(json, "tick", settings.tick, [](const JsonValue& v) { return v.number(number::positive); });
    constexpr std::string_view presets[] = {"paper", "corrected", "exact"};
    std::string name = "corrected";
    read(json, "preset", name, [&](const JsonValue& v) { return std::string(presets[v.choice(presets)]); });
    name = options.preset.value_or(name);
    settings.switches = preset(name);
    settings.arithmetic = name == "exact" ? ArithmeticSwitch::exact : ArithmeticSwitch::plain;
    if (const auto switches = json.find("switches"))
        read_switches(*switches, settings.switches);
    if (const auto box = json.find("box")) {
        box->check_keys({"min", "max"});
        settings.box_low = box->at("min").vector();
        settings.box_size = box->at("max").vector() - settings.box_low;
    }
    if (const auto camera = json.find("camera"))
        read_camera(*camera, settings.camera);
    settings.emitters.clear();
    for (const JsonValue& emitter : json.at("emitters").items()) {
        settings.emitters.push_back(read_emitter(emitter));
        settings.emitters.back().capacity = options.particles.value_or(settings.emitters.back().capacity);
    }
    for (const std::string& one : options.set)
        set_switch(one, settings.switches);
    try {
        check(settings);
    } catch (const Error& error) {
        json.fail(error.what());
    }
    return settings;
}

Settings load_scene(const std::filesystem::path& file, const SceneOptions& options) {
    const nlohmann::json document = read_json(file);
    return read_scene(JsonValue(document, file.string()), options);
}

} // namespace lockstep::lifecycle
