#pragma once
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/dust/system.hpp"
#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/fluid/system.hpp"
#include "crosscheck/lifecycle/system.hpp"
#include "crosscheck/lights/system.hpp"

namespace lockstep::test {

/// A scene of a system, with the folder of its shaders.
struct ShippedScene {
    std::string system, file;
    std::size_t particles = 0;
    std::string preset = "corrected";
    std::vector<std::string> set = {};
    std::string changes = "{}"; ///< to the file, as JSON (RFC 7396)

    [[nodiscard]] SystemScene load() const {
        const std::map<std::string, decltype(RegisteredSystem::load)> systems{
            {"dust", dust::load}, {"fluid", fluid::load}, {"lifecycle", lifecycle::load}, {"lights", lights::load}};
        const std::string path = fmt::format("data/scenes/{}/{}.json", system, file);
        nlohmann::json document = read_json(path);
        document.merge_patch(nlohmann::json::parse(changes));
        SceneOptions options;
        if (particles > 0)
            options.particles = particles;
        options.preset = preset;
        options.set = set;
        return systems.at(system)(JsonValue(document, path), file, options);
    }
};

} // namespace lockstep::test
