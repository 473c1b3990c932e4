#include "crosscheck/scene/scene_fields.hpp"

#include <cstdint>

#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "crosscheck/files/plain_text.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t last_frame = 1'000'000;
constexpr NumberRule field_of_view{1.0, 179.0, "an angle from 1 to 179 degrees"};

} // namespace

void read_field(const JsonValue& json, std::string_view key, float& value) {
    read_field(json, key, value, [](const JsonValue& v) { return v.number(); });
}

void read_field(const JsonValue& json, std::string_view key, glm::vec3& value) {
    read_field(json, key, value, [](const JsonValue& v) { return v.vector(); });
}

void read_field(const JsonValue& json, std::string_view key, int& value) {
    read_field(json, key, value, [](const JsonValue& v) { return static_cast<int>(v.integer(0, last_frame)); });
}

std::vector<JsonValue> elements(const JsonValue& json, std::size_t count, std::string_view right) {
    std::vector<JsonValue> all = json.items();
    if (all.size() != count)
        json.fail(fmt::format("{} element{}; right is {}", all.size(), all.size() == 1 ? "" : "s", right));
    return all;
}

bool parallel(glm::vec3 a, glm::vec3 b) {
    const glm::dvec3 normal = glm::cross(glm::normalize(glm::dvec3(a)), glm::normalize(glm::dvec3(b)));
    return !(glm::length(normal) > 1e-6); // also when a or b is zero
}

Camera read_camera(const JsonValue& json, const Camera& usual) {
    json.check_keys({"eye", "target", "up", "fov_y", "near", "far"});
    Camera camera = usual;
    read_field(json, "eye", camera.eye);
    read_field(json, "target", camera.target);
    read_field(json, "up", camera.up);
    read_field(json, "fov_y", camera.fov_y, [](const JsonValue& v) { return v.number(field_of_view); });
    read_field(json, "near", camera.near_plane, [](const JsonValue& v) { return v.number(number::positive); });
    read_field(json, "far", camera.far_plane, [](const JsonValue& v) { return v.number(number::positive); });
    if (camera.near_plane >= camera.far_plane)
        json.fail(fmt::format("near {} is not below far {}", camera.near_plane, camera.far_plane));
    if (parallel(camera.target - camera.eye, camera.up))
        json.fail("eye, target and up lie on one line; the camera needs a direction of view and another one up");
    return camera;
}

std::string read_preset(const JsonValue& scene, const std::optional<std::string>& instead) {
    constexpr std::string_view presets[] = {"paper", "corrected", "exact"};
    std::string name = "corrected";
    read_field(scene, "preset", name, [&](const JsonValue& v) { return std::string(presets[v.choice(presets)]); });
    return instead.value_or(name);
}

void read_values(const JsonValue& json, std::vector<SwitchValue>& all, const std::vector<std::string_view>& numbers) {
    std::vector<std::string_view> known = numbers;
    for (const SwitchValue& one : all)
        known.push_back(one.name);
    json.check_keys(known);
    for (SwitchValue& one : all)
        read_field(json, one.name, one.value, [&](const JsonValue& v) { return v.choice(one.values); });
}

void set_value(std::string_view setting, std::string_view system, std::vector<SwitchValue>& all) {
    const std::size_t equals = setting.find('=');
    const std::string_view name = setting.substr(0, equals);
    const std::string_view value = equals == setting.npos ? "" : setting.substr(equals + 1);
    const auto found = std::find_if(all.begin(), all.end(), [&](const SwitchValue& one) { return one.name == name; });
    if (found == all.end()) {
        std::vector<std::string> names(all.size());
        std::transform(all.begin(), all.end(), names.begin(), [](const SwitchValue& one) { return one.name; });
        throw Error(fmt::format("--set {}: there is no switch '{}' of {}; there are {}{}",
                                plain_line(std::string(setting)), plain_line(std::string(name)), system,
                                fmt::join(names, ", "), did_you_mean(std::string(name), names)));
    }
    const auto word = std::find(found->values.begin(), found->values.end(), value);
    if (word == found->values.end())
        throw Error(fmt::format("--set {}: '{}' is not one of {}", name, plain_line(std::string(value)),
                                fmt::join(found->values, ", ")));
    found->value = static_cast<std::size_t>(word - found->values.begin());
}

std::string differing_text(std::string_view preset, const std::vector<SwitchValue>& all,
                           const std::vector<SwitchValue>& usual) {
    std::string text;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].value != usual[i].value)
            text += fmt::format(" {}={}", all[i].name, all[i].values[all[i].value]);
    return text.empty() ? std::string(preset) : fmt::format("{}, but{}", preset, text);
}

} // namespace lockstep
