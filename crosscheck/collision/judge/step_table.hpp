#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "crosscheck/collision/judge/frame_run.hpp"
#include "crosscheck/judge/step_row.hpp"
#include "reference/collision/step_trace.hpp"

namespace lockstep {

/// One particle's step on both sides, down its twin; of a particle that the listing's pass draws, from there to who won
/// its texel.
struct StepTable {
    int frame = 0;
    std::size_t particle = 0;
    StepTrace reference; ///< with the profile
    StepCapture gpu;
    std::vector<StepRow> rows;
    /// Not empty if the trace build's outputs are not those the frame had: what is traced may then not be what
    /// happened.
    std::string warning;

    /// The first row the GPU reached by no legal way; null if there is none.
    [[nodiscard]] const StepRow* first_divergent() const;
};

StepTable step_table(FrameRun& run, std::size_t particle);

/// The same of a particle by itself, up to where it is drawn; `frame` of the table is 0.
StepTable step_table(const JudgedFrame& frame, std::size_t particle, const StepCapture& capture);

} // namespace lockstep
