#include "crosscheck/collision/judge/legal_hint.hpp"

#include <algorithm>

namespace lockstep {
namespace {

/// Calls told(frame) with the frame as it is judged by a wider rule.
template <class Told> auto by_rule(const JudgedFrame& frame, Legal legal, const Told& told) {
    const KnownOperations known = known_operations(legal, frame.profile);
    const JudgedFrame wider{frame.obstacles, frame.params,    frame.profile,       known,     frame.before,
                            frame.cdt,       frame.reference, frame.reference_cdt, frame.gpu, frame.gpu_cdt};
    return told(wider);
}

bool is_legal(const JudgedFrame& frame, std::size_t particle, Legal legal) {
    return by_rule(frame, legal, [&](const JudgedFrame& wider) {
        return judge_particle(wider, particle).kind < DifferenceClass::undefined;
    });
}

bool is_whole_legal(const JudgedFrame& frame, Legal legal) {
    return by_rule(frame, legal, [](const JudgedFrame& wider) {
        const FrameVerdicts verdicts = judge(wider);
        const auto all_legal = [](const std::vector<ItemVerdict>& items) {
            return std::all_of(items.begin(), items.end(),
                               [](const ItemVerdict& verdict) { return verdict.kind < DifferenceClass::undefined; });
        };
        return all_legal(verdicts.particles) && all_legal(verdicts.texels);
    });
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
    if (!drawn_otherwise || !by_any_order_ || frames_drawn_otherwise_++ >= judged_frames)
        return;
    by_glsl_ = by_glsl_ && is_whole_legal(frame, Legal::glsl);
    by_any_order_ = by_glsl_ || is_whole_legal(frame, Legal::any_order);
    ++tried_;
}

std::optional<Legal> LegalHint::rule() const {
    if (tried_ == 0 || !by_any_order_)
        return {};
    return by_glsl_ ? Legal::glsl : Legal::any_order;
}

} // namespace lockstep
