#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "crosscheck/collision/judge/verdict.hpp"
#include "crosscheck/judge/cause_findings.hpp"

namespace lockstep {

/// Looks for the mistake in drawing a CDT of several planes (reference/model/collision/layered_cdt.hpp) that explains
/// the texels which diverged: a plane that is not cleared, a layer that is not drawn, and such. What each mistake
/// leaves in a texel follows from what the reference draws of the GPU's own particles.
class DrawnCauseFinder {
  public:
    static constexpr int trial_frames = 4;

    DrawnCauseFinder();

    /// `stale`: what the planes held before they were drawn; null where that is not known.
    void add(const JudgedFrame& frame, const CollisionImage* stale, const std::vector<ItemVerdict>& texels);

    [[nodiscard]] CauseFindings findings() const;

    /// Whether this is the name of a mistake that it looks for.
    [[nodiscard]] static bool knows(std::string_view name);

  private:
    int frames_ = 0;
    std::uint64_t divergent_ = 0;
    std::vector<Cause> tried_;
};

} // namespace lockstep
