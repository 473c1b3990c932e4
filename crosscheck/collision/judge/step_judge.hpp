#pragma once
#include <cstddef>
#include <utility>
#include <vector>

#include "crosscheck/collision/judge/verdict.hpp"
#include "crosscheck/judge/item_verdict.hpp"
#include "crosscheck/judge/system.hpp"
#include "crosscheck/judge/verdict_summary.hpp"
#include "reference/collision/legal_texels.hpp"
#include "reference/collision/step_pass.hpp"
#include "reference/model/collision/collision_state.hpp"

namespace lockstep {

/// Calls `work` with the particles' step of a frame as a pass that its twin judges. `mixed_up`: what a host's mistakes
/// take instead, null: nothing.
template <class Work> auto with_step_pass(const JudgedFrame& frame, const FrameInputs* mixed_up, const Work& work) {
    const StepInputs inputs{frame.before, frame.cdt, frame.obstacles, frame.params, mixed_up};
    const auto pass = step_pass(inputs);
    const SystemView before = step_state(inputs);
    const View reference = view(frame.reference), gpu = view(frame.gpu);
    return work(JudgedPass{*pass, frame.profile, frame.known, 0, before, reference, gpu});
}

template <class Work> auto with_step_pass(const JudgedFrame& frame, const Work& work) {
    return with_step_pass(frame, nullptr, work);
}

/// The verdict on a differing texel by its legal owners.
ItemVerdict judge_texel(std::size_t texel, const LegalTexel& legal, glm::vec4 gpu);

/// Verdicts on a frame whose particles search otherwise than the listing's. A texel holds what is drawn there of the
/// GPU's own particles, as far as it is known how the driver computes where that is.
FrameVerdicts judge_by_twin(const JudgedFrame& frame);

/// The first component of a texel that is not what is drawn of the GPU's own particles.
WrongStep wrong_drawn_texel(const JudgedFrame& frame, std::size_t texel);

} // namespace lockstep
