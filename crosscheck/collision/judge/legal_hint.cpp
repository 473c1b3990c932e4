#include "crosscheck/collision/judge/legal_hint.hpp"

#include <algorithm>

namespace lockstep {
namespace {

bool is_legal(const JudgedFrame& frame, std::size_t particle, Legal legal) {
    const KnownOperations known = known_operations(legal, frame.profile);
    JudgedFrame wider{frame.obstacles, frame.params,    frame.profile,       known,     frame.before,
                      frame.cdt,       frame.reference, frame.reference_cdt, frame.gpu, frame.gpu_cdt};
    return judge_particle(wider, particle).kind < DifferenceClass::undefined;
}

} // namespace

void LegalHint::add(const JudgedFrame& frame, const FrameVerdicts& verdicts) {
    std::size_t tried = 0;
    for (const ItemVerdict& verdict : verdicts.particles) {
        if (verdict.kind != DifferenceClass::divergent)
            continue;
        by_glsl_ = by_glsl_ && is_legal(frame, verdict.index, Legal::glsl);
        by_any_order_ = by_any_order_ && (by_glsl_ || is_legal(frame, verdict.index, Legal::any_order));
        ++tried_;
        if (++tried == tried_a_frame || !by_any_order_)
            break;
    }
    const bool drawn_otherwise =
        std::any_of(verdicts.texels.begin(), verdicts.texels.end(), [](const ItemVerdict& verdict) {
            return verdict.kind == DifferenceClass::divergent && !verdict.follows_particle;
        });
    if (drawn_otherwise)
        by_glsl_ = by_any_order_ = false;
}

std::optional<Legal> LegalHint::rule() const {
    if (tried_ == 0 || !by_any_order_)
        return {};
    return by_glsl_ ? Legal::glsl : Legal::any_order;
}

} // namespace lockstep
