#include "crosscheck/dust/scene.hpp"

#include <algorithm>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "crosscheck/files/plain_text.hpp"
#include "reference/model/error.hpp"

namespace lockstep::dust {
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
void read(const JsonValue& json, std::string_view key, int& value) {
    read(json, key, value, [](const JsonValue& v) { return static_cast<int>(v.integer(0, last_frame)); });
}
void read(const JsonValue& json, std::string_view key, Box& value) {
    read(json, key, value, [](const JsonValue& v) {
        v.check_keys({"min", "max"});
        return Box{v.at("min").vector(), v.at("max").vector()};
    });
}
template <class Item, class Read>
void read_list(const JsonValue& json, std::string_view key, std::vector<Item>& list, Read how) {
    if (const auto found = json.find(key)) {
        list.clear();
        for (const JsonValue& item : found->items())
            list.push_back(how(item));
    }
}

Pose read_pose(const JsonValue& json) {
    json.check_keys({"frame", "position", "forward"});
    Pose pose;
    read(json, "frame", pose.frame);
    read(json, "position", pose.position);
    read(json, "forward", pose.forward);
    return pose;
}

Tool read_tool(const JsonValue& json) {
    json.check_keys({"tool", "from", "to", "force", "range", "angle", "death_range", "distance"});
    Tool tool;
    tool.kind = static_cast<Tool::Kind>(json.at("tool").choice({"vacuum", "emit", "wind"}));
    read(json, "from", tool.from);
    read(json, "to", tool.to);
    read(json, "force", tool.force);
    read(json, "range", tool.range);
    read(json, "angle", tool.angle);
    read(json, "death_range", tool.death_range);
    read(json, "distance", tool.distance);
    return tool;
}

Collider read_collider(const JsonValue& json) {
    Collider collider;
    collider.sphere = json.at("shape").choice({"sphere", "box"}) == 0;
    if (collider.sphere)
        json.check_keys({"shape", "position", "radius", "removed"});
    else
        json.check_keys({"shape", "position", "scale", "rotate", "removed"});
    read(json, "position", collider.position);
    read(json, "radius", collider.radius);
    read(json, "scale", collider.scale);
    read(json, "rotate", collider.rotate);
    read(json, "removed", collider.removed, [](const JsonValue& v) { return v.integer(0, 1) == 1; });
    return collider;
}

Ball read_ball(const JsonValue& json) {
    json.check_keys({"frame", "position", "forward", "speed", "range", "force"});
    Ball ball;
    read(json, "frame", ball.frame);
    read(json, "position", ball.position);
    read(json, "forward", ball.forward);
    read(json, "speed", ball.speed);
    read(json, "range", ball.range);
    read(json, "force", ball.force);
    return ball;
}

void read_camera(const JsonValue& json, Camera& camera) {
    json.check_keys({"eye", "target", "up", "fov_y", "near", "far"});
    read(json, "eye", camera.eye);
    read(json, "target", camera.target);
    read(json, "up", camera.up);
    read(json, "fov_y", camera.fov_y);
    read(json, "near", camera.near_plane);
    read(json, "far", camera.far_plane);
    const glm::vec3 ahead = camera.target - camera.eye;
    if (!(glm::length(glm::cross(ahead, camera.up)) > 0.0F))
        json.fail("looks nowhere: target is eye, or up points along the view");
    if (!(camera.near_plane > 0.0F && camera.far_plane > camera.near_plane))
        json.fail("near and far are no planes before it; right is 0 < near < far");
    if (!(camera.fov_y > 0.0F && camera.fov_y < 180.0F))
        json.fail("fov_y is not between 0 and 180 degrees");
}

void read_constants(const JsonValue& json, Settings& settings) {
    json.check_keys({"tick", "timescale", "gravity"});
    read(json, "tick", settings.tick);
    read(json, "timescale", settings.timescale);
    read(json, "gravity", settings.gravity);
}

void read_dust(const JsonValue& json, Settings& settings) {
    json.check_keys({"stage", "count", "scale", "mass", "air_resistance", "elasticity", "colours", "spawn", "world",
                     "controller", "tools", "colliders", "cannon"});
    read(json, "count", settings.count, [](const JsonValue& v) {
        return static_cast<std::size_t>(v.integer(1, static_cast<std::int64_t>(most_grains)));
    });
    read(json, "scale", settings.scale);
    read(json, "mass", settings.mass);
    read(json, "air_resistance", settings.air_resistance);
    read(json, "elasticity", settings.elasticity);
    if (const auto colours = json.find("colours")) {
        const std::vector<JsonValue> two = colours->items();
        if (two.size() != 2)
            colours->fail("not two colours");
        settings.colour_a = two[0].vector();
        settings.colour_b = two[1].vector();
    }
    read(json, "spawn", settings.spawn);
    settings.world = settings.spawn;
    read(json, "world", settings.world);
    read_list(json, "controller", settings.controller, read_pose);
    read_list(json, "tools", settings.tools, read_tool);
    read_list(json, "colliders", settings.colliders, read_collider);
    read_list(json, "cannon", settings.cannon, read_ball);
}

/// Switches of a file: by their names, numbers for radius_of_scale.
void read_switches(const JsonValue& json, Switches& switches) {
    std::vector<std::string_view> known{"radius_of_scale"};
    for_each_switch(switches, [&](std::string_view name, auto&, const auto&) { known.push_back(name); });
    json.check_keys(known);
    read(json, "radius_of_scale", switches.radius_of_scale);
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
            fmt::format("there is no switch '{}' of dust; there are {}", plain_line(name), fmt::join(all, ", ")));
}

} // namespace

Settings read_scene(const JsonValue& json, const SceneOptions& options) {
    json.check_keys({"description", "system", "seed", "preset", "switches", "constants", "camera", "dust"});
    static_cast<void>(json.at("system").choice({"dust"}));
    Settings settings;
    read(json, "description", settings.description, [](const JsonValue& v) { return v.label(); });
    read(json, "seed", settings.seed,
         [](const JsonValue& v) { return static_cast<std::uint32_t>(v.integer(0, 0xffffffff)); });
    constexpr std::string_view presets[] = {"paper", "corrected", "exact"};
    std::string name = "corrected";
    read(json, "preset", name, [&](const JsonValue& v) { return std::string(presets[v.choice(presets)]); });
    name = options.preset.value_or(name);
    settings.switches = preset(name);
    settings.arithmetic = name == "exact" ? ArithmeticSwitch::exact : ArithmeticSwitch::plain;
    if (const auto constants = json.find("constants"))
        read_constants(*constants, settings);
    if (const auto camera = json.find("camera"))
        read_camera(*camera, settings.camera);
    const JsonValue dust = json.at("dust");
    if (const auto version = dust.find("stage")) {
        try {
            settings.switches = stage(version->text(), settings.switches);
        } catch (const Error& error) {
            version->fail(error.what());
        }
    }
    if (const auto switches = json.find("switches"))
        read_switches(*switches, settings.switches);
    read_dust(dust, settings);
    settings.count = options.particles.value_or(settings.count);
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

} // namespace lockstep::dust
