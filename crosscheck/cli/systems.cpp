#include "crosscheck/cli/systems.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "crosscheck/dust/system.hpp"
#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/fluid/system.hpp"
#include "crosscheck/judge/registered_system.hpp"
#include "crosscheck/lifecycle/system.hpp"
#include "crosscheck/lights/system.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
namespace {

// One line a system.
const std::vector<RegisteredSystem> registered{
    {"dust", "grains that tools, balls and colliders move, by compute shaders", dust::load},
    {"fluid", "particles as a fluid's surface, drawn in screen space", fluid::load},
    {"lifecycle", "particles that are born, move, die and are packed, by compute shaders", lifecycle::load},
    {"lights", "particles that are lights, through two 3D textures", lights::load},
};

} // namespace

std::span<const RegisteredSystem> registered_systems() { return registered; }

std::string_view name_of(const RegisteredSystem& system) { return system.name; }

const RegisteredSystem* system_of_scene(const JsonValue& scene) {
    const auto value = scene.find("system");
    if (!value || value->text() == default_system)
        return nullptr;
    const std::string name = value->text();
    std::vector<std::string> names{std::string(default_system)};
    for (const RegisteredSystem& system : registered_systems()) {
        if (system.name == name)
            return &system;
        names.emplace_back(system.name);
    }
    value->fail(fmt::format("'{}' is no system; there are {}{}", plain_line(name), fmt::join(names, ", "),
                            did_you_mean(name, names)));
}

} // namespace lockstep
