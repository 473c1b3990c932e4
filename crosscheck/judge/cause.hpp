#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "crosscheck/judge/cause_findings.hpp"
#include "crosscheck/judge/verdict.hpp"
#include "reference/collision/deviating_pass.hpp"
#include "reference/collision/deviation.hpp"

namespace lockstep {

/// Deviations being tried, and what they explain.
struct TriedCause {
    std::vector<Deviation> deviations;
    std::uint64_t explained = 0, contradicted = 0; ///< as Cause has them
    std::uint64_t contradicted_before = 0;         ///< in frames before the one at hand
};

/// Looks for the named deviations (reference/collision/deviation.hpp) that explain divergence: each alone, then in
/// pairs, then three together, on the first frames with divergence; what explains all there is held against the frames
/// that follow. Where a frame diverges in a new way, what explained all before it is tried with one or two more.
class CauseFinder {
  public:
    static constexpr int trial_frames = 4;
    static constexpr std::size_t trial_items = 4096; ///< a frame

    /// The evidence of a frame with divergence. `inputs` as the frame ran, its drawn_cdt the GPU's.
    void add(const JudgedFrame& frame, const FrameVerdicts& verdicts, const FrameInputs& inputs);

    [[nodiscard]] CauseFindings particles() const;
    [[nodiscard]] CauseFindings texels() const;

  private:
    struct Trial {
        int frames = 0;
        int extensions = 0; ///< frames in which more at once were tried
        std::uint64_t divergent = 0;
        std::vector<TriedCause> causes;
        std::array<std::uint64_t, deviation_count> alone{}; ///< agreeing items that each by itself contradicts
    };
    template <class Count, class Pairs, class Best>
    static void hold_against(Trial& trial, const std::vector<std::size_t>& divergent,
                             const std::vector<TriedCause>& singles, const Count& count, const Pairs& pairs,
                             const Best& best);
    void try_on_particles(const JudgedFrame& frame, const FrameVerdicts& verdicts, const FrameInputs& inputs);
    void try_on_texels(const JudgedFrame& frame, const FrameVerdicts& verdicts, const FrameInputs& inputs);
    static CauseFindings findings(const Trial& trial);

    Trial particles_, texels_;
};

} // namespace lockstep
