#include "crosscheck/collision/judge/diagnosis.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "crosscheck/collision/judge/step_judge.hpp"
#include "crosscheck/judge/wrong_step.hpp"
#include "reference/collision/collision_code.hpp"
#include "reference/collision/collision_pass.hpp"
#include "reference/collision/legal_texels.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/same_bits.hpp"

namespace lockstep {
namespace {

Difference difference(FieldId field, std::size_t index, int component, float reference, float gpu) {
    return {field, index, component, reference, gpu, ulp_distance(reference, gpu)};
}

std::string owner_text(const TexelOwner& owner, const JudgedFrame& frame) {
    switch (owner.kind) {
    case TexelOwner::Kind::nothing:
        return "nothing";
    case TexelOwner::Kind::obstacle:
        return fmt::format("obstacle primitive {} at depth {:.9g}", owner.index, owner.reference_depth);
    case TexelOwner::Kind::particle:
        break;
    }
    const glm::vec3 position = frame.params.switches.raster_position == RasterPosition::updated
                                   ? frame.gpu.position[owner.index]
                                   : frame.before.position[owner.index];
    const PointFragment point = point_fragment(position, frame.params, frame.profile);
    return fmt::format("particle {}, drawn to ({}, {}) at depth {:.9g}", owner.index, point.x, point.y, point.depth);
}

/// In the search's words, what texels offer is how far away they are.
void tell_distances(WrongStep& wrong, float range) {
    const auto& [right, taken] = *wrong.choice;
    wrong.operation = right ? fmt::format("texel ({}, {}) is {:.9g} away, inside the range {}, and nearest", right->x,
                                          right->y, right->offer, range)
                            : fmt::format("no texel is inside the range {}", range);
    wrong.gpu = taken ? fmt::format("took ({}, {}), {:.9g} away", taken->x, taken->y, taken->offer) : "took none";
}

} // namespace

WrongStep wrong_step_of_particle(const JudgedFrame& frame, std::size_t particle) {
    WrongStep wrong = with_step_pass(frame, [&](const JudgedPass& pass) { return wrong_step_of_item(pass, particle); });
    if (wrong.choice && is_listing(frame.params.switches))
        tell_distances(wrong, frame.params.constants.collision_range);
    return wrong;
}

WrongStep wrong_step_of_texel(const JudgedFrame& frame, std::size_t texel) {
    if (!is_listing(frame.params.switches))
        return wrong_drawn_texel(frame, texel);
    const std::size_t wanted[] = {texel};
    const LegalTexel legal =
        legal_texels(frame.obstacles, frame.before, frame.gpu, frame.params, frame.profile, frame.known, wanted)[0];
    const glm::vec4 gpu = frame.gpu_cdt.texels[texel];
    const auto reference =
        std::find_if(legal.owners.begin(), legal.owners.end(), [](const TexelOwner& o) { return o.is_reference; });
    const TexelOwner owner = reference == legal.owners.end() ? legal.owners.front() : *reference;
    WrongStep wrong;
    int component = 0;
    while (component < 3 && same_bits(owner.code[component], gpu[component]))
        ++component;
    wrong.difference = difference(collision::texel, texel, component, owner.code[component], gpu[component]);
    wrong.operation = owner_text(owner, frame) + " is right";
    if (gpu.a == 0.0F) {
        wrong.step = "texel";
        wrong.gpu = "left the texel empty";
        return wrong;
    }
    const CollisionCode code(frame.params);
    for (std::size_t i = 0; i < frame.gpu.size(); ++i) {
        if (!same_bits(code.encode(frame.gpu.position[i]), gpu))
            continue;
        const TexelOwner stored{.kind = TexelOwner::Kind::particle, .index = i};
        wrong.gpu = "stored " + owner_text(stored, frame);
        const PointFragment point =
            point_fragment(frame.params.switches.raster_position == RasterPosition::updated ? frame.gpu.position[i]
                                                                                            : frame.before.position[i],
                           frame.params, frame.profile);
        const bool drawn_here = point.x >= 0 && frame.gpu_cdt.index(point.x, point.y) == texel;
        wrong.step = drawn_here ? "depth" : "window position";
        return wrong;
    }
    wrong.step = "stored value";
    wrong.gpu = "stored a position that no particle of this frame has";
    return wrong;
}

std::optional<FirstDivergence> first_of(DifferenceClass kind, int frame, const JudgedFrame& judged,
                                        const FrameVerdicts& verdicts) {
    const auto find = [&](const std::vector<ItemVerdict>& items) {
        return std::find_if(items.begin(), items.end(), [&](const ItemVerdict& item) { return item.kind == kind; });
    };
    if (const auto found = find(verdicts.particles); found != verdicts.particles.end())
        return FirstDivergence{
            {frame, collision::particles, found->index}, *found, wrong_step_of_particle(judged, found->index)};
    if (const auto found = find(verdicts.texels); found != verdicts.texels.end())
        return FirstDivergence{
            {frame, collision::cdt, found->index}, *found, wrong_step_of_texel(judged, found->index)};
    return {};
}

bool can_judge_leans(const KnownOperations& known, const Profile& profile) {
    const KnownRaster& raster = known.raster;
    return raster.point_grid && raster.point_edges && raster.triangle_grid && raster.triangle_sides &&
           profile.point_window_accurate != false && profile.corner_window_accurate != false;
}

std::optional<FirstDivergence> first_tie_beyond_rounding(int frame, const JudgedFrame& judged,
                                                         const FrameVerdicts& verdicts) {
    const auto found = std::find_if(verdicts.texels.begin(), verdicts.texels.end(), is_tie_beyond_rounding);
    if (found == verdicts.texels.end())
        return {};
    ItemVerdict convicted = *found;
    convicted.kind = DifferenceClass::divergent;
    convicted.tie = std::nullopt;
    return FirstDivergence{{frame, collision::cdt, found->index}, convicted, wrong_step_of_texel(judged, found->index)};
}

} // namespace lockstep
