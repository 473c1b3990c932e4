#include "crosscheck/lifecycle/system.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "crosscheck/lifecycle/mistakes.hpp"
#include "crosscheck/lifecycle/picture.hpp"
#include "crosscheck/lifecycle/scene.hpp"
#include "crosscheck/scene/scene_fields.hpp"
#include "gpu/lifecycle/passes.hpp"
#include "reference/lifecycle/passes.hpp"
#include "reference/model/lifecycle/bounding_polygon.hpp"
#include "reference/model/lifecycle/schema.hpp"

namespace lockstep::lifecycle {
namespace {

/// What a polygon saves of the quad's area.
std::string polygon_text(const Host& host) {
    const Sprite& sprite = host.settings().sprite;
    if (sprite.polygon == 0)
        return "";
    const auto seen = std::count_if(sprite.texture.texels.begin(), sprite.texture.texels.end(),
                                    [&](const Rgba8& texel) { return int{texel.a} > sprite.alpha_cut; });
    const std::vector<glm::dvec2> corners(host.sprite_corners().begin(), host.sprite_corners().end());
    return fmt::format("; sprite: {} of {} texels to be seen, a polygon of {} corners saves {:.1f} % of the quad", seen,
                       sprite.texture.texels.size(), corners.size(),
                       corners.empty() ? 100.0 : 100.0 * (1.0 - area(corners)));
}

/// The preset and what differs from it, and where everyone may die though ages would say who.
std::string text_of(const Host& host) {
    std::string text = switches_text(host.switches(), host.settings().arithmetic, preset);
    for (const HostEmitter& of : host.emitters())
        if (host.switches().may_die != MayDie::all && !host.lists() && of.dies == Dies::all)
            text += fmt::format("; of emitter {} any particle may die", of.number);
    for (const HostEmitter& of : host.emitters()) {
        const Emitter& e = of.settings();
        for (const GraphPtr& graph : {e.emission, e.simulation, e.rendering})
            if (graph)
                text += fmt::format("; emitter {}: {} by a graph of {} nodes", of.number, graph->stage->name,
                                    graph->order.size());
    }
    return text + polygon_text(host);
}

/// The slots in the order in which they are given: the last one first.
void bury_all(const Host& host, SystemState& state) {
    for (const HostEmitter& of : host.emitters())
        for (std::size_t i = 0; i < of.slots; ++i)
            state.set({dead_buffer, 0}, of.base + i, static_cast<std::uint32_t>(of.slots - 1 - i));
}

} // namespace

System system(const HostPtr& host, const std::string& name) {
    const Schema& of = schema(host->switches());
    const std::size_t emitters = host->emitters().size(), slots = host->slots();
    std::vector<Extent> extents{{slots},          {emitters},       {host->lists() ? 2 * slots : slots},
                                {host->blocks()}, {host->ring()},   {emitters},
                                {slots},          {host->blocks()}, {slots}};
    if (host->lists())
        extents.insert(extents.end(), {{slots}, {host->keys()}});
    System made{.name = name,
                .schema = of,
                .passes = twins(host),
                .mistakes = {},
                .start = {of, std::move(extents)},
                .settings = text_of(*host)};
    if (host->lists())
        bury_all(*host, made.start);
    for (const NamedMistake& mistake : mistakes())
        if (std::any_of(made.passes.begin(), made.passes.end(),
                        [&](const auto& pass) { return pass->name() == mistake.pass; }))
            made.mistakes.push_back(mistake);
    return made;
}

SystemScene load(const JsonValue& scene, const std::string& name, const SceneOptions& options) {
    const auto host = std::make_shared<const Host>(read_scene(scene, options));
    return {system(host, name), passes(host), host->settings().arithmetic,
            [host](const SystemState& state, int frame) { return picture(host, state, frame); }};
}

} // namespace lockstep::lifecycle
