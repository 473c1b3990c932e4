#include "crosscheck/dust/system.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "crosscheck/dust/mistakes.hpp"
#include "crosscheck/dust/picture.hpp"
#include "crosscheck/dust/scene.hpp"
#include "crosscheck/scene/scene_fields.hpp"
#include "gpu/dust/passes.hpp"
#include "reference/dust/passes.hpp"
#include "reference/model/dust/schema.hpp"

namespace lockstep::dust {
System system(const HostPtr& host, const std::string& name) {
    const Settings& settings = host->settings();
    System dust{.name = name,
                .schema = schema(),
                .passes = twins(host),
                .mistakes = {},
                .start = {schema(), {{settings.count}, {1}}},
                .settings = switches_text(settings.switches, settings.arithmetic, preset)};
    dust.start.set(field::alive_number, 0, static_cast<std::uint32_t>(settings.count));
    for (const NamedMistake& mistake : mistakes())
        if (std::any_of(dust.passes.begin(), dust.passes.end(),
                        [&](const auto& pass) { return pass->name() == mistake.pass; }))
            dust.mistakes.push_back(mistake);
    return dust;
}

SystemScene load(const JsonValue& scene, const std::string& name, const SceneOptions& options) {
    const auto host = std::make_shared<const Host>(read_scene(scene, options));
    return {system(host, name), passes(host), host->settings().arithmetic,
            [host](const SystemState& state, int frame) { return picture(host, state, frame); }};
}

} // namespace lockstep::dust
