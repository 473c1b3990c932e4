#pragma once
#include <cstddef>
#include <string>

#include "crosscheck/collision/judge/frame_run.hpp"
#include "crosscheck/collision/judge/step_table.hpp"
#include "crosscheck/report/row_text.hpp"
#include "crosscheck/report/value_text.hpp"

namespace lockstep {

/// The table of a particle: what it started from, the rows, the verdict, the first row no legal run explains, and the
/// neighbourhood as characters.
std::string explain_particle(FrameRun& run, std::size_t particle, NumberFormat format);

/// The table of a texel, then those of the particles that own it on either side.
std::string explain_texel(FrameRun& run, std::size_t texel, NumberFormat format);

/// What the particle started from.
std::string particle_head(const StepTable& table, NumberFormat format);

/// The texels looked at, row by row from the top, with both sides' base texel and pick.
std::string neighbourhood_picture(const JudgedFrame& frame, const StepTable& table);

/// What the particle started from, the rows and the neighbourhood.
std::string table_text(const JudgedFrame& frame, const StepTable& table, NumberFormat format);

/// The first row no legal run explains; empty if there is none.
std::string first_divergent_text(const StepTable& table);

/// The verdict on a particle, what it rests on, and where it first shows.
std::string why_particle(FrameRun& run, std::size_t particle, NumberFormat format);
std::string why_particle(const JudgedFrame& frame, std::size_t particle, const std::string& name, NumberFormat format);
std::string why_texel(FrameRun& run, std::size_t texel);

} // namespace lockstep
