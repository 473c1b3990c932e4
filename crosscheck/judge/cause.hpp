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
};

/// Looks for the named deviation (reference/collision/deviation.hpp) that explains divergence: each alone, then in
/// pairs, on the first frames with divergence; what explains all there is held against the frames that follow.
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
        std::uint64_t divergent = 0;
        std::vector<TriedCause> causes;
    };
    template <class Count, class Pairs>
    static void hold_against(Trial& trial, const std::vector<std::size_t>& divergent, std::vector<TriedCause> singles,
                             const Count& count, const Pairs& pairs);
    void try_on_particles(const JudgedFrame& frame, const FrameVerdicts& verdicts, const FrameInputs& inputs);
    void try_on_texels(const JudgedFrame& frame, const FrameVerdicts& verdicts, const FrameInputs& inputs);
    static CauseFindings findings(const Trial& trial);

    Trial particles_, texels_;
};

} // namespace lockstep
