#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/scene/settings_place.hpp"
#include "reference/model/arithmetic_switch.hpp"
#include "reference/model/camera.hpp"
#include "reference/model/error.hpp"

/// What the scene files of all systems have in common. Every function throws Error as JsonValue does.
namespace lockstep {

/// Reads the field `key` by `how`; a field that is not there leaves `value` as it is.
template <class Value, class Read>
void read_field(const JsonValue& json, std::string_view key, Value& value, const Read& how) {
    if (const auto found = json.find(key))
        value = how(*found);
}
void read_field(const JsonValue& json, std::string_view key, float& value);
void read_field(const JsonValue& json, std::string_view key, glm::vec3& value);
/// A frame, from 0 to a million.
void read_field(const JsonValue& json, std::string_view key, int& value);

/// Reads an array by element; a field that is not there leaves `list` as it is.
template <class Item, class Read>
void read_list(const JsonValue& json, std::string_view key, std::vector<Item>& list, const Read& how) {
    if (const auto found = json.find(key)) {
        list.clear();
        for (const JsonValue& item : found->items())
            list.push_back(how(item));
    }
}

/// The elements of an array that has `count`; `right` completes "N elements; right is ...".
std::vector<JsonValue> elements(const JsonValue& json, std::size_t count, std::string_view right);

/// A camera: eye, target, up, fov_y in degrees, near, far; what is not there is `usual`'s.
Camera read_camera(const JsonValue& json, const Camera& usual = {});

/// Whether two directions are, or one is none: no camera looks along its own up.
bool parallel(glm::vec3 a, glm::vec3 b);

/// paper, corrected or exact; corrected where the scene names none. `instead` goes before the scene's.
std::string read_preset(const JsonValue& scene, const std::optional<std::string>& instead);

/// One switch as for_each_switch (a system's switches.hpp) hands it out: the value's index in `values`.
struct SwitchValue {
    std::string_view name;
    std::size_t value;
    std::vector<std::string_view> values;
};

template <class Switches> std::vector<SwitchValue> switch_values(const Switches& switches) {
    std::vector<SwitchValue> all;
    for_each_switch(switches, [&](std::string_view name, auto value, const std::vector<std::string_view>& values) {
        all.push_back({name, static_cast<std::size_t>(value), values});
    });
    return all;
}

/// Hands the values of `all`, which is switch_values of the same type, back.
template <class Switches> void take_values(Switches& switches, const std::vector<SwitchValue>& all) {
    std::size_t at = 0;
    for_each_switch(switches, [&](std::string_view, auto& value, const auto&) {
        value = static_cast<std::decay_t<decltype(value)>>(all[at++].value);
    });
}

/// The switches of a scene; `numbers` are keys that the system reads itself.
void read_values(const JsonValue& json, std::vector<SwitchValue>& all,
                 const std::vector<std::string_view>& numbers = {});
/// One "name=value" of the command line.
void set_value(std::string_view setting, std::string_view system, std::vector<SwitchValue>& all);
/// The switches as a scene's field `switches` and then the command line's "name=value" set them.
template <class Switches> void read_switches(const JsonValue& scene, const std::vector<std::string>& set,
                                             std::string_view system, Switches& switches,
                                             const std::vector<std::string_view>& numbers = {}) {
    std::vector<SwitchValue> all = switch_values(switches);
    if (const auto written = scene.find("switches"))
        read_values(*written, all, numbers);
    for (const std::string& one : set)
        set_value(one, system, all);
    take_values(switches, all);
}

/// check(settings), its error with the scene's place.
template <class Settings> void check_settings(const JsonValue& scene, const Settings& settings) {
    try {
        check(settings);
    } catch (const Error& error) {
        fail_settings(scene, error.what());
    }
}

/// "corrected", or "corrected, but walls=all ..." with what differs from `usual`, the preset's.
std::string differing_text(std::string_view preset, const std::vector<SwitchValue>& all,
                           const std::vector<SwitchValue>& usual);
/// The same of the preset whose arithmetic it is; `preset` gives its switches by name.
template <class Switches, class Preset>
std::string switches_text(const Switches& switches, ArithmeticSwitch arithmetic, const Preset& preset) {
    const std::string_view name = arithmetic == ArithmeticSwitch::exact ? "exact" : "corrected";
    return differing_text(name, switch_values(switches), switch_values(preset(name)));
}

} // namespace lockstep
