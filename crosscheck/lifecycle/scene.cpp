#include "crosscheck/lifecycle/scene.hpp"

#include <filesystem>
#include <memory>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "crosscheck/files/named_files.hpp"
#include "crosscheck/files/png.hpp"
#include "crosscheck/scene/graph_file.hpp"
#include "crosscheck/scene/scene_fields.hpp"
#include "crosscheck/scene/scene_settings.hpp"
#include "reference/model/error.hpp"

namespace lockstep::lifecycle {
namespace {

constexpr std::int64_t last_frame = 1'000'000;
constexpr NumberRule fraction{0.0, 1.0, "a fraction from 0 to 1"};

void read_from_zero(const JsonValue& json, std::string_view key, float& value) {
    read_field(json, key, value, [](const JsonValue& v) { return v.number(number::not_negative); });
}

void read_pair(const JsonValue& json, std::string_view key, std::array<float, 2>& value) {
    read_field(json, key, value, [](const JsonValue& v) {
        const std::vector<JsonValue> two = elements(v, 2, "two numbers from 0 up");
        return std::array{two[0].number(number::not_negative), two[1].number(number::not_negative)};
    });
}

int frame_of(const JsonValue& json) { return static_cast<int>(json.integer(0, last_frame)); }

glm::vec4 read_color(const JsonValue& json) {
    const std::vector<JsonValue> four = elements(json, 4, "red, green, blue and opacity");
    return {four[0].number(), four[1].number(), four[2].number(), four[3].number()};
}

Force read_force(const JsonValue& json) {
    Force force;
    force.kind = static_cast<Force::Kind>(json.at("type").choice({"drag", "vortex", "attraction", "curl_noise"}));
    switch (force.kind) {
    case Force::Kind::drag:
        json.check_keys({"type", "k"});
        read_field(json, "k", force.k);
        break;
    case Force::Kind::vortex:
        json.check_keys({"type", "centre", "axis", "strength", "radius", "falloff", "pull"});
        break;
    case Force::Kind::attraction:
        json.check_keys({"type", "centre", "strength", "radius", "falloff", "law", "softening", "kill_radius"});
        read_field(json, "law", force.inverse_square, [](const JsonValue& v) {
            return v.choice({"linear", "inverse_square"}) == 1;
        });
        break;
    case Force::Kind::curl_noise:
        json.check_keys({"type", "strength", "frequency", "pan", "seed"});
        break;
    }
    read_field(json, "centre", force.centre);
    read_field(json, "axis", force.axis);
    read_field(json, "strength", force.strength);
    read_field(json, "radius", force.radius);
    read_field(json, "falloff", force.falloff, [](const JsonValue& v) { return static_cast<int>(v.integer(0, 2)); });
    read_field(json, "pull", force.pull);
    read_from_zero(json, "softening", force.softening);
    read_field(json, "kill_radius", force.kill_radius);
    read_field(json, "frequency", force.frequency);
    read_field(json, "pan", force.pan);
    read_field(json, "seed", force.seed,
               [](const JsonValue& v) { return static_cast<std::uint32_t>(v.integer(0, (1 << 24) - 1)); });
    return force;
}

Place read_place(const JsonValue& json) {
    json.check_keys({"frame", "position"});
    Place place;
    read_field(json, "frame", place.frame, frame_of);
    read_field(json, "position", place.position);
    return place;
}

void read_shape(const JsonValue& json, Emitter& e) {
    read_field(json, "shape", e.shape, [](const JsonValue& v) {
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
        const Box box = read_box(json);
        e.min = box.min;
        e.max = box.max;
        refuse("position");
        refuse("centre");
        refuse("radius");
        return;
    }
    read_field(json, place, e.min);
    e.max = e.min;
    read_from_zero(json, "radius", e.radius);
    refuse("min");
    refuse("max");
    refuse(e.shape == Emitter::Shape::point ? "radius" : "position");
}

Sprite read_sprite(const JsonValue& json, NamedFiles& files) {
    json.check_keys({"texture", "bounding", "alpha_cut", "filter"});
    Sprite sprite;
    if (const auto texture = json.find("texture")) {
        const NamedFiles::File file = files.read(*texture, "PNG file");
        sprite.texture = read_png(file.bytes, file.name, largest_texture);
        if (sprite.texture.width != sprite.texture.height)
            texture->fail(
                fmt::format("is {} x {} texels; right is a square", sprite.texture.width, sprite.texture.height));
    }
    if (const auto bounding = json.find("bounding")) {
        if (bounding->is_object()) {
            bounding->check_keys({"k"});
            sprite.polygon = static_cast<std::size_t>(bounding->at("k").integer(3, 8));
            if (sprite.texture.width == 0)
                bounding->fail("a polygon is fitted to a texture, and there is none");
        } else if (!bounding->is_text() || bounding->text() != "quad") {
            bounding->fail("is neither \"quad\" nor {\"k\": 3 to 8}");
        }
    }
    read_field(json, "alpha_cut", sprite.alpha_cut,
               [](const JsonValue& v) { return static_cast<int>(v.integer(0, 254)); });
    read_field(json, "filter", sprite.filter, [](const JsonValue& v) {
        return static_cast<Sprite::Filter>(v.choice({"nearest", "bilinear"}));
    });
    return sprite;
}

/// A graph as it stands, or in a file.
GraphPtr read_stage(const JsonValue& graphs, std::string_view stage, NamedFiles& files) {
    const auto given = graphs.find(stage);
    if (!given)
        return {};
    if (!given->is_text())
        return std::make_shared<const Graph>(read_graph(*given, stage));
    const NamedFiles::File file = files.read(*given, "graph");
    const nlohmann::json document = parse_json(file.bytes, file.name);
    return std::make_shared<const Graph>(read_graph(JsonValue(document, file.name), stage));
}

Emitter read_emitter(const JsonValue& json, NamedFiles& files) {
    json.check_keys(
        {"capacity", "rate", "bursts",    "lifetime",         "shape", "position",     "centre", "min",          "max",
         "radius",   "path", "direction", "direction_jitter", "speed", "speed_jitter", "cone",   "acceleration", "size",
         "color",    "draw", "uv",        "uv_scale",         "blend", "forces",       "graphs"});
    Emitter e;
    read_field(json, "capacity", e.capacity, [](const JsonValue& v) {
        return static_cast<std::size_t>(v.integer(1, static_cast<std::int64_t>(most_particles_of_emitter)));
    });
    read_field(json, "rate", e.rate, [](const JsonValue& v) { return double{v.number(number::not_negative)}; });
    if (const auto bursts = json.find("bursts"))
        for (const JsonValue& burst : bursts->items()) {
            const std::vector<JsonValue> two = elements(burst, 2, "a frame and a count");
            e.bursts.emplace_back(frame_of(two[0]), static_cast<std::uint32_t>(two[1].integer(0, 1 << 24)));
        }
    read_pair(json, "lifetime", e.lifetime);
    read_shape(json, e);
    if (const auto path = json.find("path"))
        for (const JsonValue& place : path->items())
            e.path.push_back(read_place(place));
    read_field(json, "direction", e.direction);
    read_from_zero(json, "direction_jitter", e.direction_jitter);
    read_from_zero(json, "speed", e.speed);
    read_field(json, "speed_jitter", e.speed_jitter, [](const JsonValue& v) { return v.number(fraction); });
    read_from_zero(json, "cone", e.cone);
    read_field(json, "acceleration", e.acceleration);
    read_pair(json, "size", e.size);
    if (const auto color = json.find("color")) {
        const std::vector<JsonValue> two = elements(*color, 2, "two colours, the first and the last");
        e.color = {read_color(two[0]), read_color(two[1])};
    }
    read_field(json, "draw", e.draw, [](const JsonValue& v) {
        return static_cast<Emitter::Draw>(v.choice({"sprite", "ribbon"}));
    });
    read_field(json, "uv", e.uv, [](const JsonValue& v) {
        return static_cast<Emitter::Uv>(v.choice({"segment", "stretched", "distance"}));
    });
    read_field(json, "uv_scale", e.uv_scale);
    read_field(json, "blend", e.blend, [](const JsonValue& v) {
        return static_cast<Emitter::Blend>(v.choice({"over", "additive", "opaque"}));
    });
    if (const auto forces = json.find("forces"))
        for (const JsonValue& force : forces->items())
            e.forces.push_back(read_force(force));
    if (const auto graphs = json.find("graphs")) {
        graphs->check_keys({"emission", "simulation", "rendering"});
        e.emission = read_stage(*graphs, "emission", files);
        e.simulation = read_stage(*graphs, "simulation", files);
        e.rendering = read_stage(*graphs, "rendering", files);
    }
    return e;
}

} // namespace

Settings read_scene(const JsonValue& json, const SceneOptions& options) {
    json.check_keys({"description", "system", "seed", "preset", "tick", "switches", "box", "camera", "render", "sprite",
                     "emitters"});
    static_cast<void>(json.at("system").choice({"lifecycle"}));
    Settings settings;
    read_field(json, "description", settings.description, [](const JsonValue& v) { return v.label(); });
    read_field(json, "seed", settings.seed,
               [](const JsonValue& v) { return static_cast<std::uint64_t>(v.integer(0, std::int64_t{0xffffffff})); });
    read_field(json, "tick", settings.tick, [](const JsonValue& v) { return v.number(number::positive); });
    const std::string name = read_preset(json, options.preset);
    settings.switches = preset(name);
    settings.arithmetic = name == "exact" ? ArithmeticSwitch::exact : ArithmeticSwitch::plain;
    read_switches(json, options.set, "lifecycle", settings.switches);
    if (const auto box = json.find("box")) {
        box->check_keys({"min", "max"});
        settings.box_low = box->at("min").vector();
        settings.box_size = box->at("max").vector() - settings.box_low;
    }
    if (const auto camera = json.find("camera"))
        settings.camera = read_camera(*camera, settings.camera);
    if (const auto render = json.find("render")) {
        const std::vector<JsonValue> two = elements(*render, 2, "the width and height of pictures");
        settings.width = static_cast<int>(two[0].integer(1, 8192));
        settings.height = static_cast<int>(two[1].integer(1, 8192));
    }
    NamedFiles beside;
    NamedFiles& files = options.files ? *options.files : beside;
    if (const auto sprite = json.find("sprite"))
        settings.sprite = read_sprite(*sprite, files);
    settings.emitters.clear();
    for (const JsonValue& emitter : json.at("emitters").items()) {
        settings.emitters.push_back(read_emitter(emitter, files));
        settings.emitters.back().capacity = options.particles.value_or(settings.emitters.back().capacity);
    }
    check_settings(json, settings);
    return settings;
}

Settings load_scene(const std::filesystem::path& file, const SceneOptions& options) {
    const nlohmann::json document = read_json(file);
    return read_scene(JsonValue(document, file.string()), options);
}

} // namespace lockstep::lifecycle
