#include "crosscheck/lights/scene.hpp"

#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "crosscheck/scene/scene_fields.hpp"
#include "crosscheck/scene/scene_obstacles.hpp"
#include "crosscheck/scene/scene_settings.hpp"
#include "reference/model/random.hpp"

namespace lockstep::lights {
namespace {

constexpr NumberRule fraction{0.0, 1.0, "a fraction from 0 to 1"};

glm::ivec3 read_size(const JsonValue& json) {
    const std::vector<JsonValue> three = elements(json, 3, "the voxels along x, y and z");
    glm::ivec3 size;
    for (int axis = 0; axis < 3; ++axis)
        size[axis] = static_cast<int>(three[static_cast<std::size_t>(axis)].integer(2, 256));
    return size;
}

void read_grid(const JsonValue& json, Grid& grid) {
    json.check_keys({"size", "voxel", "origin"});
    read_field(json, "size", grid.size, read_size);
    read_field(json, "voxel", grid.voxel);
    read_field(json, "origin", grid.origin);
}

/// Lights in a box, each by its own random numbers: place, way and colour.
struct LightGroup {
    std::size_t count = 1;
    glm::vec3 min{0.0F}, max{0.0F};
    float speed = 0.0F, jitter = 1.0F, range = 4.0F, intensity = 1.0F;
    std::vector<glm::vec3> palette{glm::vec3(1.0F)};
};

glm::vec3 read_colour(const JsonValue& json) {
    const glm::vec3 colour = json.vector();
    for (const JsonValue& channel : json.items())
        static_cast<void>(channel.number(number::not_negative));
    return colour;
}

LightGroup read_group(const JsonValue& json) {
    LightGroup group;
    const bool is_point = json.at("shape").choice({"box", "point"}) == 1;
    if (is_point) {
        json.check_keys({"shape", "count", "position", "speed", "direction_jitter", "range", "palette", "intensity"});
        read_field(json, "position", group.min);
        group.max = group.min;
    } else {
        json.check_keys({"shape", "count", "min", "max", "speed", "direction_jitter", "range", "palette", "intensity"});
        const Box box = read_box(json);
        group.min = box.min;
        group.max = box.max;
    }
    read_field(json, "count", group.count, [](const JsonValue& v) {
        return static_cast<std::size_t>(v.integer(1, static_cast<std::int64_t>(most_lights)));
    });
    const auto from_zero = [](const JsonValue& v) { return v.number(number::not_negative); };
    read_field(json, "speed", group.speed, from_zero);
    read_field(json, "direction_jitter", group.jitter, [](const JsonValue& v) { return v.number(fraction); });
    read_field(json, "range", group.range);
    read_field(json, "intensity", group.intensity, from_zero);
    read_list(json, "palette", group.palette, read_colour);
    if (group.palette.empty())
        json.fail("a palette has at least one colour");
    return group;
}

/// In the plane where `jitter` is 0.
glm::vec3 random_direction(Random& random, float jitter) {
    for (;;) {
        const glm::dvec3 v(random.symmetric(), double{jitter} * random.symmetric(), random.symmetric());
        const double squared = v.x * v.x + v.y * v.y + v.z * v.z;
        if (squared > 1e-4 && squared <= 1.0)
            return glm::vec3(v / std::sqrt(squared));
    }
}

void add_group(const LightGroup& group, std::size_t count, Settings& settings) {
    for (std::size_t k = 0; k < count; ++k) {
        Random random(settings.seed, settings.lights.size());
        Light light;
        for (int axis = 0; axis < 3; ++axis)
            light.position[axis] = static_cast<float>(
                double{group.min[axis]} + random.unit() * (double{group.max[axis]} - double{group.min[axis]}));
        light.direction = random_direction(random, group.jitter);
        light.speed = group.speed;
        light.range = group.range;
        const auto entry = static_cast<std::size_t>(random.unit() * static_cast<double>(group.palette.size()));
        light.colour = group.palette[entry] * group.intensity;
        settings.lights.push_back(light);
    }
}

/// Of `count` lights in all each group gets its share. Throws Error before a light is made where they are too many.
void add_lights(const JsonValue& json, const std::optional<std::size_t>& count, Settings& settings) {
    std::vector<LightGroup> groups;
    for (const JsonValue& one : json.items())
        groups.push_back(read_group(one));
    std::size_t all = 0;
    for (const LightGroup& group : groups)
        all += group.count;
    if (const std::size_t made = count.value_or(all); made > most_lights)
        json.fail(fmt::format("{} lights; right is 1 to {}", made, most_lights));
    std::size_t before = 0, given = 0;
    for (const LightGroup& group : groups) {
        before += group.count;
        const std::size_t upto = count ? *count * before / all : before;
        add_group(group, upto - given, settings);
        given = upto;
    }
}

void add_obstacles(const JsonValue& json, Obstacles& obstacles) {
    constexpr std::array<std::string_view, 1> own{"albedo"};
    for (const JsonValue& one : json.items()) {
        read_obstacle(one, std::nullopt, obstacles.mesh, own);
        glm::vec3 albedo(0.75F);
        read_field(one, "albedo", albedo);
        const glm::vec3 codes = albedo * 256.0F;
        for (int c = 0; c < 3; ++c)
            if (codes[c] != std::floor(codes[c]) || !(codes[c] >= 0.0F && codes[c] <= 255.0F))
                one.at("albedo").fail("an albedo is three multiples of 1/256, below 1");
        obstacles.albedo.resize(obstacles.mesh.triangle_count(), glm::ivec3(codes));
    }
}

void read_constants(const JsonValue& json, Settings& settings) {
    json.check_keys({"tick", "ambient", "background", "glow_radius", "glow_gain", "fixed_bits"});
    read_field(json, "tick", settings.tick);
    read_field(json, "ambient", settings.ambient);
    read_field(json, "background", settings.background);
    read_field(json, "glow_radius", settings.glow_radius);
    read_field(json, "glow_gain", settings.glow_gain);
    read_field(json, "fixed_bits", settings.fixed_bits,
               [](const JsonValue& v) { return std::optional(static_cast<int>(v.integer(0, 31))); });
}

} // namespace

Settings read_scene(const JsonValue& json, const SceneOptions& options) {
    json.check_keys({"description", "system", "seed", "preset", "switches", "constants", "camera", "image", "grid",
                     "lights", "obstacles"});
    static_cast<void>(json.at("system").choice({"lights"}));
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
    if (const auto image = json.find("image")) {
        const std::vector<JsonValue> two = elements(*image, 2, "its width and height");
        settings.width = static_cast<int>(two[0].integer(1, 8192));
        settings.height = static_cast<int>(two[1].integer(1, 8192));
    }
    read_grid(json.at("grid"), settings.grid);
    read_switches(json, options.set, "lights", settings.switches);
    add_lights(json.at("lights"), options.particles, settings);
    add_obstacles(json.at("obstacles"), settings.obstacles);
    check_settings(json, settings);
    return settings;
}

Settings load_scene(const std::filesystem::path& file, const SceneOptions& options) {
    const nlohmann::json document = read_json(file);
    return read_scene(JsonValue(document, file.string()), options);
}

} // namespace lockstep::lights
