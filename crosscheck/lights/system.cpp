#include "crosscheck/lights/system.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/judge/coded_image.hpp"
#include "crosscheck/lights/left_open.hpp"
#include "crosscheck/lights/mistakes.hpp"
#include "crosscheck/lights/scene.hpp"
#include "crosscheck/scene/scene_fields.hpp"
#include "gpu/lights/passes.hpp"
#include "reference/lights/passes.hpp"
#include "reference/model/lights/schema.hpp"

namespace lockstep::lights {

System system(const HostPtr& host, const std::string& name) {
    System made{.name = name,
                .schema = schema(host->switches()),
                .passes = twins(host),
                .mistakes = {},
                .start = start(host->settings()),
                .settings = switches_text(host->switches(), host->settings().arithmetic, preset)};
    for (const NamedMistake& mistake : mistakes())
        if (std::any_of(made.passes.begin(), made.passes.end(),
                        [&](const auto& pass) { return pass->name() == mistake.pass; }))
            made.mistakes.push_back(mistake);
    return made;
}

namespace {

Floor floor_of(const HostPtr& host) {
    AtomicsAlone alone = atomics_alone(host);
    if (alone.passes.empty())
        return {};
    return {std::move(alone.passes), fmt::format("{} atomics in each of {} voxels of each light, and nothing else",
                                                 alone.words, alone.voxels_each)};
}

} // namespace

SystemScene load(const JsonValue& scene, const std::string& name, const SceneOptions& options) {
    const auto host = std::make_shared<const Host>(read_scene(scene, options));
    return {system(host, name),
            passes(host),
            host->settings().arithmetic,
            {},
            [](const SystemState& state) { return coded_image(state, field::code); },
            [host](const Profile& profile) { return left_open(host->switches(), profile); },
            [host] { return floor_of(host); }};
}

} // namespace lockstep::lights
