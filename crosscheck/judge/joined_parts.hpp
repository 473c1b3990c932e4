#pragma once
#include "crosscheck/judge/check.hpp"

namespace lockstep {

/// Reports on parts of one run, before they are concluded, come to the report on the whole: counts add up, of what came
/// first the first stays, and a mistake would have shown where it would have in any part. Two things follow from all
/// frames together: the causes of what diverges, and the rule by which it would be legal. Where both parts have
/// divergent frames, neither is known afterwards; judge_frames finds them on verdicts->divergent_frames alone.
/// `next` follows `run` frame by frame. Throws Error where they are no parts of one run.
void join(CheckReport& run, const CheckReport& next);

} // namespace lockstep
