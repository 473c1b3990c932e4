#include "crosscheck/cli/systems.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/judge/registered_system.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
std::string_view name_of(const RegisteredSystem& system) { return system.name; }

const RegisteredSystem* system_of_scene(const JsonValue& scene) {
    const auto value = scene.find("system");
    // A check file has passes, and need not say what it is.
    if (!value && !scene.find("passes") && !scene.find("state"))
        return nullptr;
    const std::string name = value ? value->text() : std::string(own_system);
    if (name == default_system)
        return nullptr;
    std::vector<std::string> names{std::string(default_system)};
    for (const RegisteredSystem& system : registered_systems()) {
        if (system.name == name)
            return &system;
        if (system.name != own_system) // which passes say
            names.emplace_back(system.name);
    }
    if (const auto left_out = left_out_systems(); std::find(left_out.begin(), left_out.end(), name) != left_out.end())
        value->fail(fmt::format("this program is built without system {}; cmake -DLOCKSTEP_SYSTEMS adds it", name));
    value->fail(fmt::format("'{}' is no system; there are {}{}", plain_line(name), fmt::join(names, ", "),
                            did_you_mean(name, names)));
}

} // namespace lockstep
