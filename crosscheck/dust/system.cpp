#include "crosscheck/dust/system.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "crosscheck/dust/mistakes.hpp"
#include "crosscheck/dust/picture.hpp"
#include "crosscheck/dust/scene.hpp"
#include "gpu/dust/passes.hpp"
#include "reference/dust/passes.hpp"
#include "reference/model/dust/schema.hpp"

namespace lockstep::dust {
namespace {

/// "random=integer suction=force_kernel ...", and so on for what differs from the preset `corrected`.
std::string text_of(const Switches& switches) {
    std::string text;
    const Switches corrected;
    std::vector<int> usual;
    for_each_switch(corrected,
                    [&](std::string_view, auto value, const auto&) { usual.push_back(static_cast<int>(value)); });
    std::size_t at = 0;
    for_each_switch(switches, [&](std::string_view name, auto value, const std::vector<std::string_view>& names) {
        if (static_cast<int>(value) != usual[at++])
            text += fmt::format("{}{}={}", text.empty() ? "" : " ", name, names[static_cast<std::size_t>(value)]);
    });
    return text.empty() ? "corrected" : "corrected, but " + text;
}

} // namespace

System system(const HostPtr& host, const std::string& name) {
    const Settings& settings = host->settings();
    System dust{.name = name,
                .schema = schema(),
                .passes = twins(host),
                .mistakes = {},
                .start = {schema(), {{settings.count}, {1}}},
                .settings = text_of(settings.switches)};
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
