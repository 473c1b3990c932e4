#pragma once
#include <cstddef>
#include <optional>

#include "crosscheck/collision/judge/verdict.hpp"
#include "crosscheck/judge/verdict_summary.hpp"

namespace lockstep {

WrongStep wrong_step_of_particle(const JudgedFrame& frame, std::size_t particle);
WrongStep wrong_step_of_texel(const JudgedFrame& frame, std::size_t texel);

/// The first item of a class in a frame: a particle if there is one, whose texel may only follow it.
std::optional<FirstDivergence> first_of(DifferenceClass kind, int frame, const JudgedFrame& judged,
                                        const FrameVerdicts& verdicts);

/// Whether a shift of what is drawn is no tie, though each texel by itself may be one: the driver's grid was measured,
/// and nothing says that its window coordinates are less accurate than GLSL's.
bool can_judge_leans(const KnownOperations& known, const Profile& profile);

/// The first texel that by itself is a tie, and that a shift explains better than rounding.
std::optional<FirstDivergence> first_tie_beyond_rounding(int frame, const JudgedFrame& judged,
                                                         const FrameVerdicts& verdicts);

} // namespace lockstep
