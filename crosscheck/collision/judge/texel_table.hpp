#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "crosscheck/collision/judge/frame_run.hpp"
#include "crosscheck/judge/step_rows.hpp"

namespace lockstep {

/// A texel: everybody who was drawn to it on either side, its owners and what is stored.
struct TexelTable {
    int frame = 0;
    std::size_t texel = 0;
    std::vector<StepRow> rows;
    std::vector<std::size_t> particles; ///< the owners' step tables tell more: the reference's, then the GPU's
};

TexelTable texel_table(FrameRun& run, std::size_t texel);

/// "(3, 4)", or "none" of what lies outside.
std::string texel_text(glm::ivec2 texel);

/// The depths at which GL may draw a particle to a texel; null: GL may not draw it there.
std::optional<Interval> legal_depth(const JudgedFrame& frame, glm::ivec2 texel, std::size_t particle);

/// Who else wanted a texel, who won it and what it stores: the last rows of a particle's table.
void add_contest(FrameRun& run, glm::ivec2 texel, std::size_t particle, StepRows& rows);

} // namespace lockstep
