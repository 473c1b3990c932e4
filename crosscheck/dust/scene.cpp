#include "crosscheck/dust/scene.hpp"

#include <string_view>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "crosscheck/scene/scene_fields.hpp"
#include "reference/model/error.hpp"

namespace lockstep::dust {
namespace {

void read_box(const JsonValue& json, std::string_view key, Box& value) {
    read_field(json, key, value, [](const JsonValue& v) {
        v.check_keys({"min", "max"});
        return Box{v.at("min").vector(), v.at("max").vector()};
    });
}
Pose read_pose(const JsonValue& json) {
    json.check_keys({"frame", "position", "forward"});
    Pose pose;
    read_field(json, "frame", pose.frame);
    read_field(json, "position", pose.position);
    read_field(json, "forward", pose.forward);
    return pose;
}

void refuse(const JsonValue& json, std::string_view key, std::string_view tool) {
    if (const auto found = json.find(key))
        found->fail(fmt::format("is no property of {}; right is to leave it out", tool));
}

Tool read_tool(const JsonValue& json) {
    json.check_keys({"tool", "from", "to", "force", "range", "angle", "death_range", "distance"});
    Tool tool;
    tool.kind = static_cast<Tool::Kind>(json.at("tool").choice({"vacuum", "emit", "wind"}));
    const std::string name = json.at("tool").text();
    if (tool.kind == Tool::Kind::emit)
        refuse(json, "range", name);
    if (tool.kind != Tool::Kind::vacuum)
        refuse(json, "death_range", name);
    if (tool.kind != Tool::Kind::emit)
        refuse(json, "distance", name);
    read_field(json, "from", tool.from);
    read_field(json, "to", tool.to);
    read_field(json, "force", tool.force);
    read_field(json, "range", tool.range);
    read_field(json, "angle", tool.angle);
    read_field(json, "death_range", tool.death_range);
    read_field(json, "distance", tool.distance);
    return tool;
}

Collider read_collider(const JsonValue& json) {
    Collider collider;
    collider.sphere = json.at("shape").choice({"sphere", "box"}) == 0;
    if (collider.sphere)
        json.check_keys({"shape", "position", "radius", "removed"});
    else
        json.check_keys({"shape", "position", "scale", "rotate", "removed"});
    read_field(json, "position", collider.position);
    read_field(json, "radius", collider.radius);
    read_field(json, "scale", collider.scale);
    read_field(json, "rotate", collider.rotate);
    read_field(json, "removed", collider.removed, [](const JsonValue& v) { return v.integer(0, 1) == 1; });
    return collider;
}

Ball read_ball(const JsonValue& json) {
    json.check_keys({"frame", "position", "forward", "speed", "range", "force"});
    Ball ball;
    read_field(json, "frame", ball.frame);
    read_field(json, "position", ball.position);
    read_field(json, "forward", ball.forward);
    read_field(json, "speed", ball.speed);
    read_field(json, "range", ball.range);
    read_field(json, "force", ball.force);
    return ball;
}

void read_constants(const JsonValue& json, Settings& settings) {
    json.check_keys({"tick", "timescale", "gravity"});
    read_field(json, "tick", settings.tick);
    read_field(json, "timescale", settings.timescale);
    read_field(json, "gravity", settings.gravity);
}

void read_dust(const JsonValue& json, Settings& settings) {
    json.check_keys({"stage", "count", "scale", "mass", "air_resistance", "elasticity", "colours", "spawn", "world",
                     "controller", "tools", "colliders", "cannon"});
    read_field(json, "count", settings.count, [](const JsonValue& v) {
        return static_cast<std::size_t>(v.integer(1, static_cast<std::int64_t>(most_grains)));
    });
    read_field(json, "scale", settings.scale);
    read_field(json, "mass", settings.mass);
    read_field(json, "air_resistance", settings.air_resistance);
    read_field(json, "elasticity", settings.elasticity);
    if (const auto colours = json.find("colours")) {
        const std::vector<JsonValue> two = elements(*colours, 2, "two colours");
        settings.colour_a = two[0].vector();
        settings.colour_b = two[1].vector();
    }
    read_box(json, "spawn", settings.spawn);
    settings.world = settings.spawn;
    read_box(json, "world", settings.world);
    read_list(json, "controller", settings.controller, read_pose);
    read_list(json, "tools", settings.tools, read_tool);
    read_list(json, "colliders", settings.colliders, read_collider);
    read_list(json, "cannon", settings.cannon, read_ball);
}

} // namespace

Settings read_scene(const JsonValue& json, const SceneOptions& options) {
    json.check_keys({"description", "system", "seed", "preset", "switches", "constants", "camera", "dust"});
    static_cast<void>(json.at("system").choice({"dust"}));
    Settings settings;
    read_field(json, "description", settings.description, [](const JsonValue& v) { return v.label(); });
    read_field(json, "seed", settings.seed,
               [](const JsonValue& v) { return static_cast<std::uint32_t>(v.integer(0, 0xffffffff)); });
    const std::string name = read_preset(json, options.preset);
    settings.switches = preset(name);
    settings.arithmetic = name == "exact" ? ArithmeticSwitch::exact : ArithmeticSwitch::plain;
    if (const auto constants = json.find("constants"))
        read_constants(*constants, settings);
    if (const auto camera = json.find("camera"))
        settings.camera = read_camera(*camera, settings.camera);
    const JsonValue dust = json.at("dust");
    if (const auto version = dust.find("stage")) {
        const std::string stage_name = version->text();
        try {
            settings.switches = stage(stage_name, settings.switches);
        } catch (const Error& error) {
            version->fail(error.what());
        }
    }
    read_switches(json, options.set, "dust", settings.switches, {"radius_of_scale"});
    if (const auto written = json.find("switches"))
        read_field(*written, "radius_of_scale", settings.switches.radius_of_scale);
    read_dust(dust, settings);
    settings.count = options.particles.value_or(settings.count);
    check_settings(json, settings);
    return settings;
}

Settings load_scene(const std::filesystem::path& file, const SceneOptions& options) {
    const nlohmann::json document = read_json(file);
    return read_scene(JsonValue(document, file.string()), options);
}

} // namespace lockstep::dust
