#include "crosscheck/judge/step_judge.hpp"

#include <algorithm>

#include "crosscheck/judge/compare.hpp"
#include "crosscheck/judge/item_judge.hpp"
#include "reference/model/same_bits.hpp"

namespace lockstep {

FrameVerdicts judge_by_twin(const JudgedFrame& frame) {
    FrameVerdicts verdicts{with_step_pass(frame, judge_items), {}};
    const std::vector<std::size_t> differing = differing_items(frame.reference_cdt, frame.gpu_cdt);
    if (differing.empty())
        return verdicts;
    const CollisionImage redrawn = redraw(frame);
    ItemVerdict followed{.kind = DifferenceClass::rounding, .follows_particle = true};
    for (const ItemVerdict& particle : verdicts.particles)
        followed.kind = std::max(followed.kind, particle.kind);
    const bool known = frame.known.sums && frame.known.divide && frame.known.raster.triangles();
    for (const std::size_t texel : differing) {
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
