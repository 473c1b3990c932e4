#include "crosscheck/collision/judge/step_judge.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "crosscheck/judge/compare.hpp"
#include "crosscheck/judge/item_judge.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/same_bits.hpp"

namespace lockstep {

namespace {

/// The planes of a CDT that only obstacles are drawn into, by camera; texels of no such plane have none.
std::optional<int> camera_of_walls(const JudgedFrame& frame, std::size_t texel) {
    if (frame.params.switches.search == Search::depth)
        return 0;
    if (!has_remedies(frame.params.switches))
        return {};
    const CdtPlanes planes = cdt_planes(frame.params.switches);
    const auto plane_texels =
        static_cast<std::size_t>(frame.params.width) * static_cast<std::size_t>(frame.params.height);
    const auto plane = static_cast<int>(texel / plane_texels);
    for (int camera = 0; camera < planes.cameras; ++camera)
        if (plane == planes.obstacles(camera))
            return camera;
    return {};
}

/// A texel that an obstacle may have, by itself: triangles cover what GL lets them cover.
ItemVerdict judge_wall(const JudgedFrame& frame, std::size_t texel, int camera) {
    FrameParams seen = frame.params;
    if (camera == 1)
        seen.collision_proj_view = frame.params.second_proj_view;
    const auto plane_texels = static_cast<std::size_t>(seen.width) * static_cast<std::size_t>(seen.height);
    const std::size_t wanted[] = {texel % plane_texels};
    const LegalTexel legal =
        legal_texels(frame.obstacles, Particles(), Particles(), seen, frame.profile, frame.known, wanted).front();
    return judge_texel(texel, legal, frame.gpu_cdt.texels[texel]);
}

} // namespace

ItemVerdict judge_texel(std::size_t texel, const LegalTexel& legal, glm::vec4 gpu) {
    ItemVerdict verdict{.index = texel, .outcomes = legal.owners.size()};
    const TexelOwner* owner = legal.owner_of(gpu);
    if (owner == nullptr)
        return verdict;
    const std::vector<Tie> ties = legal.ties(*owner);
    verdict.kind = ties.empty() ? DifferenceClass::rounding : DifferenceClass::tie;
    if (!ties.empty())
        verdict.tie = ties.front();
    const auto [low, high] = owner->code_range.value_or(std::pair(owner->code, owner->code));
    for (int c = 0; c < 4; ++c)
        verdict.sets.emplace_back(static_cast<double>(low[c]), static_cast<double>(high[c]));
    return verdict;
}

FrameVerdicts judge_by_twin(const JudgedFrame& frame) {
    FrameVerdicts verdicts{with_step_pass(frame, judge_items), {}};
    const std::vector<std::size_t> differing = differing_items(frame.reference_cdt, frame.gpu_cdt);
    if (differing.empty())
        return verdicts;
    const CollisionImage redrawn = redraw(frame);
    ItemVerdict followed{.kind = DifferenceClass::rounding, .follows_particle = true};
    for (const ItemVerdict& particle : verdicts.particles)
        followed.kind = std::max(followed.kind, particle.kind);
    const bool known = frame.known.sums && frame.known.divide;
    for (const std::size_t texel : differing) {
        if (const auto camera = camera_of_walls(frame, texel)) {
            verdicts.texels.push_back(judge_wall(frame, texel, *camera));
            continue;
        }
        ItemVerdict verdict = followed;
        if (verdicts.particles.empty() || !same_bits(redrawn.texels[texel], frame.gpu_cdt.texels[texel]))
            verdict = {.kind = known ? DifferenceClass::divergent : DifferenceClass::undefined,
                       .undefined = known ? Undefined::none : Undefined::undecided};
        verdict.index = texel;
        verdicts.texels.push_back(verdict);
    }
    return verdicts;
}

WrongStep wrong_drawn_texel(const JudgedFrame& frame, std::size_t texel) {
    const CollisionImage redrawn = redraw(frame);
    const View reference = view(redrawn), gpu = view(frame.gpu_cdt);
    int component = 0;
    while (component < 3 && same_bits(reference.value(0, texel, component), gpu.value(0, texel, component)))
        ++component;
    const Value expected = reference.value(0, texel, component), got = gpu.value(0, texel, component);
    WrongStep wrong;
    wrong.step = "drawn texel";
    wrong.operation = "what is drawn of the GPU's own particles";
    wrong.difference = {collision::texel, texel, component, expected, got, distance(expected, got)};
    return wrong;
}

} // namespace lockstep
