#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crosscheck/judge/frame_run.hpp"
#include "crosscheck/judge/step_row.hpp"
#include "reference/collision/step_trace.hpp"

namespace lockstep {

/// One particle's step on both sides, down the listing: clip position, texture coordinate, base texel, own position,
/// every neighbour, response or integration, gl_Position, window position, texel, depth, who else wanted the texel and
/// who won it.
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

/// The same of a particle by itself, up to where it is drawn. `capture`: null where nothing of the GPU's steps is
/// known; the table then ends with the particle's new state. Its number of the frame is 0.
StepTable step_table(const JudgedFrame& frame, std::size_t particle, const StepCapture* capture);

/// A texel: everybody who was drawn to it on either side, its owners and what is stored.
struct TexelTable {
    int frame = 0;
    std::size_t texel = 0;
    std::vector<StepRow> rows;
    std::vector<std::size_t> particles; ///< the owners' step tables tell more: the reference's, then the GPU's
};

TexelTable texel_table(FrameRun& run, std::size_t texel);

} // namespace lockstep
