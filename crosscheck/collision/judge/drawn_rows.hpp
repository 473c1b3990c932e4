#pragma once
#include <cstddef>
#include <vector>

#include "crosscheck/collision/judge/frame_run.hpp"
#include "crosscheck/judge/step_row.hpp"
#include "reference/collision/step_trace.hpp"

namespace lockstep {

/// What became of a particle after its vertex stage, below the rows of its step: what was captured, where its point was
/// drawn, who else wanted that texel and who won it. `run`: null where the particle is alone; then nobody else did.
std::vector<StepRow> with_drawn_rows(std::vector<StepRow> step, const JudgedFrame& frame, std::size_t particle,
                                     const StepCapture& capture, const StepTrace& reference, FrameRun* run);

} // namespace lockstep
