#pragma once
#include <cstddef>
#include <optional>

#include "crosscheck/collision/judge/verdict.hpp"
#include "crosscheck/judge/legal.hpp"

namespace lockstep {

/// Whether what diverges by what was measured of a driver is legal by a wider rule: a right shader that computes the
/// same in another way, rounding otherwise, is.
class LegalHint {
  public:
    static constexpr std::size_t tried_a_frame = 32;
    static constexpr std::size_t judged_frames = 16; ///< as a whole, where a point is drawn otherwise

    /// The divergent items of a frame that was judged by Legal::measured.
    void add(const JudgedFrame& frame, const FrameVerdicts& verdicts);

    /// The narrowest rule by which every particle that was tried is legal, and every frame with points that are
    /// drawn otherwise; none.
    [[nodiscard]] std::optional<Legal> rule() const;

  private:
    std::size_t tried_ = 0, frames_drawn_otherwise_ = 0;
    bool by_glsl_ = true, by_any_order_ = true;
};

} // namespace lockstep
