#include "crosscheck/collision/record/pixel_capsule_json.hpp"

#include <array>

#include <fmt/format.h>

#include "crosscheck/collision/record/particle_json.hpp"
#include "crosscheck/files/asked_memory.hpp"
#include "crosscheck/scene/profile_json.hpp"
#include "crosscheck/scene/scene_settings.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

using nlohmann::json;

constexpr std::int64_t pixel_version = 1;
constexpr std::string_view mark = "lockstep_pixel_capsule";

/// [number in the run, state, state a frame before].
json particles_json(const PixelCapsule& capsule) {
    json list = json::array();
    for (std::size_t i = 0; i < capsule.particle_numbers.size(); ++i)
        list.push_back({capsule.particle_numbers[i], state_json(capsule.particles[i]), state_json(capsule.earlier[i])});
    return list;
}

/// [number in the run, corner, corner, corner].
json triangles_json(const PixelCapsule& capsule) {
    json list = json::array();
    for (std::size_t i = 0; i < capsule.triangle_numbers.size(); ++i) {
        json triangle{capsule.triangle_numbers[i]};
        for (std::size_t k = 0; k < 3; ++k)
            triangle.push_back(vector_text(capsule.triangles.positions[capsule.triangles.indices[i * 3 + k]]));
        list.push_back(triangle);
    }
    return list;
}

std::vector<JsonValue> parts_of(const JsonValue& item, std::size_t count, std::string_view what) {
    std::vector<JsonValue> parts = item.items();
    if (parts.size() != count)
        item.fail(fmt::format("not {}", what));
    return parts;
}

std::uint32_t number_of(const JsonValue& value) { return static_cast<std::uint32_t>(value.integer(0, INT32_MAX)); }

void read_particles(const JsonValue& value, PixelCapsule& capsule) {
    const std::vector<JsonValue> items = value.items();
    capsule.particles.resize(items.size());
    capsule.earlier.resize(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        const auto parts = parts_of(items[i], 3, "[number, state, state a frame before]");
        capsule.particle_numbers.push_back(number_of(parts[0]));
        capsule.particles.set(i, read_state(parts[1]));
        capsule.earlier.set(i, read_state(parts[2]));
    }
}

void read_triangles(const JsonValue& value, PixelCapsule& capsule) {
    for (const JsonValue& item : value.items()) {
        const auto parts = parts_of(item, 4, "[number, corner, corner, corner]");
        capsule.triangle_numbers.push_back(number_of(parts[0]));
        for (std::size_t k = 1; k < 4; ++k) {
            capsule.triangles.indices.push_back(static_cast<std::uint32_t>(capsule.triangles.positions.size()));
            capsule.triangles.positions.push_back(read_vector<3>(parts[k]));
        }
    }
}

Rgba8 read_color(const JsonValue& value) {
    const auto parts = parts_of(value, 4, "[red, green, blue, alpha]");
    const auto code = [](const JsonValue& part) { return static_cast<std::uint8_t>(part.integer(0, 255)); };
    return {code(parts[0]), code(parts[1]), code(parts[2]), code(parts[3])};
}

std::vector<std::string> read_causes(const JsonValue& value) {
    std::vector<std::string_view> names;
    for (const RenderMistakeInfo& info : render_mistakes())
        names.push_back(info.name);
    std::vector<std::string> causes;
    for (const JsonValue& cause : value.items())
        causes.emplace_back(names[cause.choice(names)]);
    return causes;
}

} // namespace

std::string capsule_file(const PixelCapsule& cut) {
    PixelCapsule capsule = cut;
    for (std::string* text : {&capsule.scene.name, &capsule.renderer, &capsule.settings})
        *text = as_utf8(*text);
    const auto width = static_cast<std::size_t>(capsule.scene.render_width);
    const std::string place =
        fmt::format("pixel {},{} in frame {}", capsule.pixel % width, capsule.pixel / width, capsule.frame);
    const json document{{mark, pixel_version},
                        {"scene", capsule.scene.name},
                        {"settings", settings_json(capsule.scene)},
                        {"renderer", capsule.renderer},
                        {"switches", capsule.settings},
                        {"frame", capsule.frame},
                        {"pixel", {capsule.pixel % width, capsule.pixel / width}},
                        {"profile", profile_json(capsule.profile)},
                        {"roots", roots_json(capsule.profile,
                                             [&](const Profile& watched) {
                                                 PixelCapsule looked_into = capsule;
                                                 looked_into.profile = watched;
                                                 static_cast<void>(table_of(looked_into));
                                             })},
                        {"known", known_json(capsule.known)},
                        {"particles", particles_json(capsule)},
                        {"triangles", triangles_json(capsule)},
                        {"gpu", {capsule.gpu.r, capsule.gpu.g, capsule.gpu.b, capsule.gpu.a}},
                        {"divergent", capsule.divergent},
                        {"causes", capsule.causes}};
    const std::string text = document.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
    if (text.size() > largest_capsule)
        throw Error(
            fmt::format("{}: its capsule would be {} bytes, right is at most {}", place, text.size(), largest_capsule));
    const json back = parse_json(text, "capsule");
    if (capsule_text(read_pixel_capsule(JsonValue(back, "capsule")), NumberFormat::hexadecimal) !=
        capsule_text(capsule, NumberFormat::hexadecimal))
        throw Error(fmt::format("{}: read back, its capsule says something else; this is a bug", place));
    return text;
}

bool is_pixel_capsule(const JsonValue& value) { return value.find(mark).has_value(); }

PixelCapsule read_pixel_capsule(const JsonValue& value) {
    static_cast<void>(value.at(mark).integer(pixel_version, pixel_version));
    value.check_keys({mark, "scene", "settings", "renderer", "switches", "frame", "pixel", "profile", "roots", "known",
                      "particles", "triangles", "gpu", "divergent", "causes"});
    PixelCapsule capsule;
    const JsonValue settings = value.at("settings");
    settings.check_keys(scene_keys);
    read_settings(settings, {}, {}, capsule.scene);
    capsule.scene.name = value.at("scene").label();
    capsule.renderer = value.at("renderer").label();
    capsule.settings = value.at("switches").label();
    capsule.frame = static_cast<int>(value.at("frame").integer(0, 1'000'000'000));
    const int width = capsule.scene.render_width, height = capsule.scene.render_height;
    expect_affordable({static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height), 1}, 0, "capsule");
    const auto pixel = parts_of(value.at("pixel"), 2, "[x, y]");
    capsule.pixel = static_cast<std::size_t>(pixel[1].integer(0, height - 1)) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(pixel[0].integer(0, width - 1));
    capsule.profile = read_profile(value.at("profile"));
    capsule.profile.roots = read_roots(value.at("roots"));
    capsule.known = read_known(value.at("known"));
    read_particles(value.at("particles"), capsule);
    read_triangles(value.at("triangles"), capsule);
    capsule.gpu = read_color(value.at("gpu"));
    capsule.divergent = static_cast<std::uint64_t>(value.at("divergent").integer(0, std::int64_t{1} << 40));
    capsule.causes = read_causes(value.at("causes"));
    return capsule;
}

} // namespace lockstep
