#pragma once
#include "crosscheck/text/examination.hpp"
#include "crosscheck/text/made_up_world.hpp"
#include "reference/model/profile.hpp"
#include "reference/text/stage_run.hpp"

namespace lockstep {

/// What a stage's text leaves of a world, and what was found on the way.
struct WatchedRun {
    MadeUpWorld world;
    text::Writers writers;     ///< of a compute stage that is compared with a reference
    text::StageResult outputs; ///< of another stage that is
    text::Findings findings;
    text::Coverage coverage;
};

/// Runs a stage with the arithmetic of GLSL alone. `stage`: what runs of it, unless it is a compute stage.
WatchedRun run_watched(const Examination& of, const text::Program& program, MadeUpWorld world,
                       const text::StageRun& stage);

/// The arithmetic of that run.
const Profile& examined_profile();

/// Whether the run ended early, in a loop that does not end.
bool is_endless(const text::Findings& findings);

} // namespace lockstep
