#include "crosscheck/scene/scene_settings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "crosscheck/scene/scene_constants.hpp"
#include "crosscheck/scene/scene_fields.hpp"
#include "crosscheck/scene/scene_frames.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t largest_image = 16384;

/// A way is straight, so it comes nearest to a view along the camera's up, or to none, in one place: the frames on both
/// sides of it are looked at.
void check_way(const JsonValue& json, const Camera& camera, const CameraKey& a, const CameraKey& b) {
    const glm::dvec3 up = glm::normalize(glm::dvec3(camera.up));
    const glm::dvec3 first = glm::cross(glm::dvec3(a.target) - glm::dvec3(a.eye), up);
    const glm::dvec3 change = glm::cross(glm::dvec3(b.target) - glm::dvec3(b.eye), up) - first;
    const double squared = glm::dot(change, change);
    const double nearest = squared > 0.0 ? std::clamp(-glm::dot(first, change) / squared, 0.0, 1.0) : 0.0;
    const int before = a.frame + static_cast<int>(std::floor(nearest * (b.frame - a.frame)));
    for (const int frame : {before, before + 1}) {
        const Camera at = camera_at(camera, {a, b}, frame);
        if (parallel(at.target - at.eye, at.up))
            json.fail(
                fmt::format("on the way here, in frame {}, eye, target and the camera's up lie on one line; right "
                            "is a key that leads around it",
                            frame));
    }
}

/// Only where all keys are right by themselves.
void check_camera_path(const JsonValue& json, const Camera& camera, const std::vector<CameraKey>& path) {
    const std::vector<JsonValue> items = json.items();
    for (std::size_t k = 0; k < items.size(); ++k) {
        if (!items[k].find("eye") && !items[k].find("target"))
            items[k].fail("a key without eye and target; right is one of them, or both");
        if (k > 0)
            check_way(items[k], camera, path[k - 1], path[k]);
    }
}

std::vector<CameraKey> read_camera_path(const JsonValue& json, const Camera& camera) {
    std::vector<CameraKey> path;
    for (const JsonValue& item : json.items()) {
        item.check_keys({"frame", "eye", "target"});
        CameraKey key{static_cast<int>(item.at("frame").integer(0, 1'000'000'000)), camera.eye, camera.target};
        read_field(item, "eye", key.eye);
        read_field(item, "target", key.target);
        if (!path.empty() && key.frame <= path.back().frame)
            item.fail(fmt::format("frame {} does not come after frame {}; keys are sorted by frame", key.frame,
                                  path.back().frame));
        if (parallel(key.target - key.eye, camera.up))
            item.fail("eye, target and the camera's up lie on one line");
        path.push_back(key);
    }
    check_camera_path(json, camera, path);
    return path;
}

void read_size(const JsonValue& json, int& width, int& height) {
    const std::vector<JsonValue> size = json.items();
    if (size.size() != 2)
        json.fail("a size is two integers, [width, height]");
    width = static_cast<int>(size[0].integer(1, largest_image));
    height = static_cast<int>(size[1].integer(1, largest_image));
}

void read_switches(const JsonValue& json, Switches& switches) {
    std::vector<std::string_view> names;
    for (const SwitchInfo& info : switch_table())
        names.push_back(info.name);
    json.check_keys(names);
    for (const SwitchInfo& info : switch_table())
        if (const auto value = json.find(info.name)) {
            if (info.number != nullptr)
                switches.*info.number = value->number();
            else
                info.set(switches, static_cast<int>(value->choice(info.values)));
        }
}

/// Of the switches and the constants.
std::string nearest_setting(const std::string& name) {
    std::vector<std::string> names;
    for (const SwitchInfo& info : switch_table())
        names.emplace_back(info.name);
    for (const std::string_view constant : constant_names())
        names.emplace_back(constant);
    return did_you_mean(name, names);
}

void apply_setting(const std::string& setting, Scene& scene) {
    constexpr std::size_t longest = 200; // far more than a name and three numbers
    if (setting.size() > longest)
        throw Error(fmt::format("--set {}...: {} characters; a setting has at most {}", setting.substr(0, 20),
                                setting.size(), longest));
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0)
        throw Error(fmt::format("--set {}: a setting is name=value", setting));
    const std::string name = setting.substr(0, equals);
    const std::string text = setting.substr(equals + 1);

    const auto constants = constant_names();
    if (std::find(constants.begin(), constants.end(), name) != constants.end()) {
        nlohmann::json value = text;
        try {
            value = parse_json(name == "gravity" && !text.starts_with('[') ? "[" + text + "]" : text, "--set");
        } catch (const Error&) { // a text, which no constant is
        }
        return set_constant(scene.constants, name, JsonValue(value, "--set", name));
    }
    std::vector<std::string_view> switches;
    for (const SwitchInfo& info : switch_table())
        switches.push_back(info.name);
    if (std::find(switches.begin(), switches.end(), name) == switches.end())
        throw Error(fmt::format("--set {}: nothing is named '{}'; the switches are {}; the constants are {}{}", setting,
                                name, fmt::join(switches, ", "), fmt::join(constants, ", "), nearest_setting(name)));
    set_switch(scene.switches, name, text);
}

nlohmann::json vector_json(glm::vec3 v) { return {v.x, v.y, v.z}; }

nlohmann::json camera_json(const Camera& camera) {
    return {{"eye", vector_json(camera.eye)}, {"target", vector_json(camera.target)},
            {"up", vector_json(camera.up)},   {"fov_y", camera.fov_y},
            {"near", camera.near_plane},      {"far", camera.far_plane}};
}

nlohmann::json switches_json(const Switches& switches) {
    nlohmann::json json = nlohmann::json::object();
    for (const SwitchInfo& info : switch_table()) {
        if (info.number != nullptr)
            json[std::string(info.name)] = switches.*info.number;
        else
            json[std::string(info.name)] = switch_value(switches, info.name);
    }
    return json;
}

} // namespace

Box read_box(const JsonValue& json) {
    const Box box{json.at("min").vector(), json.at("max").vector()};
    for (int axis = 0; axis < 3; ++axis)
        if (box.min[axis] > box.max[axis])
            json.fail(
                fmt::format("min is above max in {}; a box goes from its lowest to its highest corner", "xyz"[axis]));
    return box;
}

void read_settings(const JsonValue& json, const std::optional<std::string>& preset_name,
                   const std::vector<std::string>& set, Scene& scene) {
    if (const auto description = json.find("description"))
        static_cast<void>(description->text());

    std::string base = "corrected";
    if (const auto name = json.find("preset")) {
        base = name->text();
        try {
            static_cast<void>(preset(base));
        } catch (const Error& error) {
            name->fail(error.what());
        }
    }
    scene.switches = preset(preset_name.value_or(base));
    if (const auto switches = json.find("switches"))
        read_switches(*switches, scene.switches);
    if (const auto constants = json.find("constants"))
        read_constants(*constants, scene.constants);
    for (const std::string& setting : set)
        apply_setting(setting, scene);
    check_switches(scene.switches);

    if (const auto camera = json.find("camera"))
        scene.camera = read_camera(*camera);
    if (const auto path = json.find("camera_path"))
        scene.camera_path = read_camera_path(*path, scene.camera);
    const auto collision_camera = json.find("collision_camera");
    scene.collision_camera = collision_camera ? read_camera(*collision_camera) : scene.camera;

    if (const auto size = json.find("image"))
        read_size(*size, scene.width, scene.height);
    if (const auto size = json.find("render"))
        read_size(*size, scene.render_width, scene.render_height);
    if (const auto box = json.find("cdt_box")) {
        box->check_keys({"min", "max"});
        scene.cdt_box = read_box(*box);
        for (int axis = 0; axis < 3; ++axis)
            if (!(scene.cdt_box.min[axis] < scene.cdt_box.max[axis]))
                box->fail(fmt::format("the box has no extent in {}", "xyz"[axis]));
    }
    if (const auto space = json.find("clip_space"))
        scene.clip_space = read_clip_space(*space, scene.switches);
    if (const auto frames = json.find("frames"))
        scene.frames = read_frames(*frames, scene);
}

nlohmann::json settings_json(const Scene& scene) {
    nlohmann::json path = nlohmann::json::array();
    for (const CameraKey& key : scene.camera_path)
        path.push_back({{"frame", key.frame}, {"eye", vector_json(key.eye)}, {"target", vector_json(key.target)}});
    nlohmann::json json{
        {"switches", switches_json(scene.switches)},
        {"constants", constants_json(scene.constants)},
        {"camera", camera_json(scene.camera)},
        {"camera_path", path},
        {"collision_camera", camera_json(scene.collision_camera)},
        {"image", {scene.width, scene.height}},
        {"render", {scene.render_width, scene.render_height}},
        {"cdt_box", {{"min", vector_json(scene.cdt_box.min)}, {"max", vector_json(scene.cdt_box.max)}}}};
    if (scene.clip_space != ClipSpace{})
        json["clip_space"] = clip_space_json(scene.clip_space);
    if (!scene.frames.empty())
        json["frames"] = frames_json(scene);
    return json;
}

} // namespace lockstep
