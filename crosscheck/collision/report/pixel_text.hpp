#pragma once
#include <cstddef>
#include <string>

#include "crosscheck/collision/judge/frame_run.hpp"
#include "crosscheck/collision/judge/pixel_table.hpp"
#include "crosscheck/report/value_text.hpp"

namespace lockstep {

/// A pixel of the frame that the run stands at: both sides' colour, the verdict, everything that may be drawn there and
/// what hides it, and the mistakes that explain the whole frame. `gpu`: that frame, as the GPU drew it.
std::string explain_pixel(FrameRun& run, const ColorImage& gpu, std::size_t pixel, NumberFormat format);

std::string pixel_text(const PixelTable& table, NumberFormat format);

} // namespace lockstep
