#pragma once
#include <cstddef>
#include <string>

#include "crosscheck/collision/judge/frame_run.hpp"
#include "crosscheck/collision/judge/pixel_table.hpp"
#include "crosscheck/report/value_text.hpp"

namespace lockstep {

/// What the frame that a run stands at is drawn of, and the verdict on it. The run has to outlive it and stand still.
class JudgedPicture {
  public:
    /// `gpu`: the frame as the GPU drew it.
    JudgedPicture(const FrameRun& run, ColorImage gpu);

    [[nodiscard]] RenderInputs inputs() const;
    [[nodiscard]] const JudgedFrame& frame() const { return frame_; }
    [[nodiscard]] const RenderVerdict& verdict() const { return verdict_; }
    [[nodiscard]] Rgba8 gpu(std::size_t pixel) const { return gpu_.texels[pixel]; }
    [[nodiscard]] PixelTable table(std::size_t pixel) const;

  private:
    JudgedFrame frame_;
    FrameParams earlier_params_;
    ColorImage gpu_;
    RenderVerdict verdict_;
};

/// Both sides' colour, the verdict, everything that may be drawn there and what hides it, and the mistakes that explain
/// the whole frame.
std::string pixel_text(const PixelTable& table, NumberFormat format);

} // namespace lockstep
