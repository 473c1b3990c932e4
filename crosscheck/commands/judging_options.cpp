#include "crosscheck/commands/judging_options.hpp"

#include <map>
#include <string>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {

void add_legal_option(CLI::App& verb, Legal& legal) {
    verb.add_option("--legal", legal,
                    "what differences are judged by: what the driver was measured to do; GLSL's precision rules; "
                    "these for shaders without `precise`")
        ->transform(CLI::CheckedTransformer(std::map<std::string, Legal>{
            {"measured", Legal::measured}, {"glsl", Legal::glsl}, {"any_order", Legal::any_order}}))
        ->type_name("measured|glsl|any_order");
}

KnownOperations known_operations(Legal legal, const Profile& profile) {
    return legal == Legal::measured ? measured_operations(profile) : KnownOperations{.sums = legal == Legal::glsl};
}

std::string legal_option_text(Legal legal) {
    if (legal == Legal::measured)
        return "";
    return legal == Legal::glsl ? " --legal glsl" : " --legal any_order";
}

void check_particle(const Scene& scene, std::size_t particle) {
    if (particle >= scene.start.size())
        throw Error(
            fmt::format("there is no particle {}; {} has 0 to {}", particle, scene.name, scene.start.size() - 1));
}

std::size_t texel_index(const Scene& scene, std::pair<int, int> texel) {
    const auto [x, y] = texel;
    if (x < 0 || y < 0 || x >= scene.width || y >= scene.height)
        throw Error(fmt::format("there is no texel ({}, {}); the CDT has (0, 0) to ({}, {})", x, y, scene.width - 1,
                                scene.height - 1));
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(scene.width) + static_cast<std::size_t>(x);
}

} // namespace lockstep
