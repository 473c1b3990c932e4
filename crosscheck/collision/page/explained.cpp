#include "crosscheck/collision/page/explained.hpp"

#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/collision/judge/neighbourhood.hpp"
#include "crosscheck/collision/judge/step_table.hpp"
#include "crosscheck/collision/judge/texel_table.hpp"
#include "crosscheck/collision/report/explain_text.hpp"
#include "crosscheck/report/page/rows_json.hpp"
#include "reference/model/collision/collision_state.hpp"

namespace lockstep {
namespace {

using nlohmann::json;

json texel_json(glm::ivec2 texel) { return texel.x < 0 ? json() : json{texel.x, texel.y}; }

/// Of each field its name and the components' values.
json state_json(const View& item) {
    json fields = json::array();
    for (std::size_t f = 0; f < item.fields().size(); ++f) {
        json values = json::array();
        for (int c = 0; c < item.fields()[f].components; ++c)
            values.push_back(number_json(item.value(f, 0, c)));
        fields.push_back({{"name", item.fields()[f].name}, {"values", values}});
    }
    return fields;
}

json neighbourhood_json(const FrameRun& run, const StepTable& table) {
    const auto round = neighbourhood(table, run.scene().constants.texel_collide_range);
    if (!round)
        return nullptr;
    const CollisionImage& cdt = run.judged().cdt;
    json cells = json::array(); // from the bottom; '.' empty, 'o' drawn, ' ' outside
    for (int y = round->low.y; y <= round->high.y; ++y) {
        std::string row;
        for (int x = round->low.x; x <= round->high.x; ++x)
            row += !cdt.contains(x, y) ? ' ' : cdt.at(x, y).a != 0.0F ? 'o' : '.';
        cells.push_back(row);
    }
    return {{"low", {round->low.x, round->low.y}},
            {"cells", cells},
            {"reference", {{"base", texel_json(round->base)}, {"nearest", texel_json(round->pick)}}},
            {"gpu", {{"base", texel_json(round->gpu_base)}, {"nearest", texel_json(round->gpu_pick)}}}};
}

json particle_json(FrameRun& run, std::size_t particle) {
    const StepTable table = step_table(run, particle);
    return {{"particle", particle},
            {"before", state_json(view(table.reference.before))},
            {"warning", table.warning},
            {"untraced", table.gpu.vertex.outputs.empty()},
            {"rows", rows_json(table.rows)},
            {"neighbourhood", neighbourhood_json(run, table)},
            {"why", why_particle(run, particle, NumberFormat::decimal)}};
}

} // namespace

json explained(FrameRun& run, const PageItem& item) {
    run.go_to(item.frame);
    if (!item.texel)
        return {{"particles", {particle_json(run, item.index)}}};
    const TexelTable table = texel_table(run, item.index);
    json particles = json::array();
    for (const std::size_t particle : table.particles)
        particles.push_back(particle_json(run, particle));
    return {{"texel", {{"rows", rows_json(table.rows)}, {"why", why_texel(run, item.index)}}},
            {"particles", particles}};
}

} // namespace lockstep
