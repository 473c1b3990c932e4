#include "crosscheck/fluid/system.hpp"

#include <algorithm>

#include "crosscheck/fluid/left_open.hpp"
#include "crosscheck/fluid/mistakes.hpp"
#include "crosscheck/fluid/scene.hpp"
#include "crosscheck/judge/coded_image.hpp"
#include "crosscheck/scene/scene_fields.hpp"
#include "gpu/fluid/passes.hpp"
#include "reference/fluid/passes.hpp"
#include "reference/model/fluid/schema.hpp"

namespace lockstep::fluid {

System system(const HostPtr& host, const std::string& name) {
    System made{.name = name,
                .schema = schema(host->switches()),
                .passes = twins(host),
                .mistakes = {},
                .start = start(host->settings()),
                .settings = switches_text(host->switches(), host->settings().arithmetic, preset)};
    for (const NamedMistake& mistake : mistakes(*host))
        if (std::any_of(made.passes.begin(), made.passes.end(),
                        [&](const auto& pass) { return pass->name() == mistake.pass; }))
            made.mistakes.push_back(mistake);
    return made;
}

SystemScene load(const JsonValue& scene, const std::string& name, const SceneOptions& options) {
    const auto host = std::make_shared<const Host>(read_scene(scene, options));
    return {system(host, name),
            passes(host),
            host->settings().arithmetic,
            {},
            [](const SystemState& state) { return coded_image(state, field::code); },
            [host](const Profile& profile) { return left_open(host->switches(), profile); }};
}

} // namespace lockstep::fluid
