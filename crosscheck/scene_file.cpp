#include "crosscheck/scene_file.hpp"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "crosscheck/json_reader.hpp"
#include "crosscheck/scene_constants.hpp"
#include "crosscheck/surface.hpp"
#include "reference/model/emitters.hpp"
#include "reference/model/error.hpp"
#include "reference/model/layered_cdt.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t largest_image = 16384;
constexpr std::int64_t largest_seed = (std::int64_t{1} << 53) - 1; // every JSON reader keeps it
constexpr std::int64_t most_segments = 512;
constexpr NumberRule field_of_view{1.0, 179.0, "an angle from 1 to 179 degrees"};
constexpr NumberRule fraction{0.0, 1.0, "a fraction from 0 to 1"};
constexpr NumberRule direction_jitter{0.0, 0.5, "a number from 0 to 0.5"};

bool parallel(glm::vec3 a, glm::vec3 b) {
    const glm::dvec3 normal = glm::cross(glm::normalize(glm::dvec3(a)), glm::normalize(glm::dvec3(b)));
    return !(glm::length(normal) > 1e-6); // also when a or b is zero
}

Box read_box(const JsonValue& json) {
    const Box box{json.at("min").vector(), json.at("max").vector()};
    for (int axis = 0; axis < 3; ++axis)
        if (box.min[axis] > box.max[axis])
            json.fail(
                fmt::format("min is above max in {}; a box goes from its lowest to its highest corner", "xyz"[axis]));
    return box;
}

Camera read_camera(const JsonValue& json) {
    json.check_keys({"eye", "target", "up", "fov_y", "near", "far"});
    Camera camera;
    if (const auto eye = json.find("eye"))
        camera.eye = eye->vector();
    if (const auto target = json.find("target"))
        camera.target = target->vector();
    if (const auto up = json.find("up"))
        camera.up = up->vector();
    if (const auto fov_y = json.find("fov_y"))
        camera.fov_y = fov_y->number(field_of_view);
    if (const auto near = json.find("near"))
        camera.near_plane = near->number(number::positive);
    if (const auto far = json.find("far"))
        camera.far_plane = far->number(number::positive);
    if (camera.near_plane >= camera.far_plane)
        json.fail(fmt::format("near {} is not below far {}", camera.near_plane, camera.far_plane));
    if (parallel(camera.target - camera.eye, camera.up))
        json.fail("eye, target and up lie on one line; the camera needs a direction of view and another one up");
    return camera;
}

std::vector<CameraKey> read_camera_path(const JsonValue& json, const Camera& camera) {
    std::vector<CameraKey> path;
    for (const JsonValue& item : json.items()) {
        item.check_keys({"frame", "eye", "target"});
        CameraKey key{static_cast<int>(item.at("frame").integer(0, 1'000'000'000)), camera.eye, camera.target};
        if (const auto eye = item.find("eye"))
            key.eye = eye->vector();
        if (const auto target = item.find("target"))
            key.target = target->vector();
        if (!path.empty() && key.frame <= path.back().frame)
            item.fail(fmt::format("frame {} does not come after frame {}; keys are sorted by frame", key.frame,
                                  path.back().frame));
        if (parallel(key.target - key.eye, camera.up))
            item.fail("eye, target and the camera's up lie on one line");
        path.push_back(key);
    }
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

void read_constants(const JsonValue& json, Constants& constants) {
    json.check_keys(constant_names());
    for (const std::string_view name : constant_names())
        if (const auto value = json.find(name))
            set_constant(constants, name, *value);
}

Emitter read_emitter(const JsonValue& json) {
    Emitter emitter;
    if (const auto shape = json.find("shape"))
        emitter.shape = static_cast<EmitterShape>(shape->choice({"box", "lattice", "shell"}));
    if (emitter.shape == EmitterShape::shell)
        json.check_keys(
            {"shape", "count", "min", "max", "thickness", "direction", "direction_jitter", "speed", "speed_jitter"});
    else
        json.check_keys({"shape", "count", "min", "max", "direction", "direction_jitter", "speed", "speed_jitter"});
    emitter.count = static_cast<std::size_t>(json.at("count").integer(1, most_particles));
    emitter.box = read_box(json);
    if (const auto thickness = json.find("thickness"))
        emitter.thickness = thickness->number(fraction);
    if (const auto direction = json.find("direction")) {
        emitter.direction = direction->vector();
        if (!(glm::length(glm::dvec3(emitter.direction)) > 0.0))
            direction->fail("a direction has a length above 0");
    }
    if (const auto jitter = json.find("direction_jitter"))
        emitter.direction_jitter = jitter->number(direction_jitter);
    if (const auto speed = json.find("speed"))
        emitter.speed = speed->number(number::not_negative);
    if (const auto jitter = json.find("speed_jitter"))
        emitter.speed_jitter = jitter->number(fraction);
    return emitter;
}

std::vector<Emitter> read_emitters(const JsonValue& json) {
    std::vector<Emitter> emitters;
    std::size_t total = 0;
    for (const JsonValue& item : json.items()) {
        emitters.push_back(read_emitter(item));
        total += emitters.back().count;
        if (total > most_particles)
            item.fail(fmt::format("{} particles up to here; a scene has at most {}", total, most_particles));
    }
    if (emitters.empty())
        json.fail("no emitters, so no particles; a scene has at least one");
    return emitters;
}

Surface read_surface(const JsonValue& json, Placement& placement, const std::filesystem::path& folder) {
    const auto real = [&](std::string_view key) { return static_cast<double>(json.at(key).number(number::positive)); };
    const auto segments = [&](int otherwise) {
        const auto value = json.find("segments");
        return value ? static_cast<int>(value->integer(4, most_segments)) : otherwise;
    };
    switch (json.at("shape").choice({"mesh", "plane", "box", "sphere", "torus"})) {
    case 0: {
        json.check_keys({"shape", "file", "height", "position", "rotate_y"});
        const JsonValue file = json.at("file");
        const auto path = (folder / file.text()).lexically_normal();
        placement.height = real("height");
        try {
            return load_surface(path);
        } catch (const Error& error) {
            file.fail(error.what());
        }
    }
    case 1: {
        json.check_keys({"shape", "size", "position", "rotate_y"});
        const JsonValue size = json.at("size");
        const std::vector<JsonValue> sides = size.items();
        if (sides.size() != 2)
            size.fail("the size of a plane is two numbers above 0, [x, z]");
        return plane_surface(sides[0].number(number::positive), sides[1].number(number::positive));
    }
    case 2: {
        json.check_keys({"shape", "size", "position", "rotate_y"});
        const JsonValue size = json.at("size");
        const glm::vec3 sides = size.vector();
        for (const JsonValue& side : size.items())
            static_cast<void>(side.number(number::positive));
        return box_surface(sides);
    }
    case 3:
        json.check_keys({"shape", "radius", "segments", "position", "rotate_y"});
        return sphere_surface(real("radius"), segments(16));
    default:
        json.check_keys({"shape", "radius", "tube_radius", "segments", "position", "rotate_y"});
        return torus_surface(real("radius"), real("tube_radius"), segments(48));
    }
}

void read_obstacle(const JsonValue& json, const std::filesystem::path& folder, Mesh& mesh) {
    Placement placement;
    const Surface surface = read_surface(json, placement, folder);
    if (const auto position = json.find("position"))
        placement.position = position->vector();
    if (const auto angle = json.find("rotate_y"))
        placement.rotate_y = angle->number();
    place(surface, placement, mesh);
}

void apply_setting(const std::string& setting, Scene& scene) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos)
        throw Error(fmt::format("--set {}: a setting is name=value", setting));
    const std::string name = setting.substr(0, equals);
    const std::string text = setting.substr(equals + 1);

    const auto constants = constant_names();
    if (std::find(constants.begin(), constants.end(), name) != constants.end()) {
        nlohmann::json value = nlohmann::json::parse(
            name == "gravity" && !text.starts_with('[') ? "[" + text + "]" : text, nullptr, false);
        if (value.is_discarded())
            value = text;
        return set_constant(scene.constants, name, JsonValue(value, "--set", name));
    }
    std::vector<std::string_view> switches;
    for (const SwitchInfo& info : switch_table())
        switches.push_back(info.name);
    if (std::find(switches.begin(), switches.end(), name) == switches.end())
        throw Error(fmt::format("--set {}: nothing is named {}; the switches are {}; the constants are {}", setting,
                                name, fmt::join(switches, ", "), fmt::join(constants, ", ")));
    set_switch(scene.switches, name, text);
}

} // namespace

Scene load_scene(const std::filesystem::path& file, const SceneOptions& options) {
    if (options.particles && (*options.particles < 1 || *options.particles > most_particles))
        throw Error(fmt::format("--particles {}: not an integer from 1 to {}", *options.particles, most_particles));

    const nlohmann::json document = read_json(file);
    const JsonValue json(document, file.string());
    json.check_keys({"description", "seed", "preset", "switches", "constants", "camera", "camera_path",
                     "collision_camera", "image", "render", "cdt_box", "emitters", "obstacles"});
    Scene scene;
    scene.name = file.stem().string();
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
    scene.switches = preset(options.preset.value_or(base));
    if (const auto switches = json.find("switches"))
        read_switches(*switches, scene.switches);
    if (const auto constants = json.find("constants"))
        read_constants(*constants, scene.constants);
    for (const std::string& setting : options.set)
        apply_setting(setting, scene);
    check_remedies(scene.switches);

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

    std::vector<Emitter> emitters = read_emitters(json.at("emitters"));
    const auto seed_value = json.find("seed");
    const std::int64_t seed = seed_value ? seed_value->integer(0, largest_seed) : 1;
    if (const auto obstacles = json.find("obstacles"))
        for (const JsonValue& obstacle : obstacles->items())
            read_obstacle(obstacle, file.parent_path(), scene.obstacles);

    if (options.particles)
        scale_counts(emitters, *options.particles);
    if (options.emitter_length != 1.0F)
        scale_lengths(emitters, options.emitter_length);
    scene.start = emit(emitters, static_cast<std::uint64_t>(seed));
    return scene;
}

} // namespace lockstep
