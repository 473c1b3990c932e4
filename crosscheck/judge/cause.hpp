#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "crosscheck/judge/verdict.hpp"
#include "reference/deviating_pass.hpp"
#include "reference/deviation.hpp"

namespace lockstep {

/// One deviation, or two at once, and what it explains: where the reference that makes it has the GPU's bits. On a
/// driver whose division or roots were measured to err, all fields as near as a few of these errors allow.
struct Cause {
    std::vector<Deviation> deviations;
    std::uint64_t explained = 0;    ///< divergent particles or texels
    std::uint64_t contradicted = 0; ///< ones that agree, and would not

    [[nodiscard]] std::string name() const; ///< "a", "a + b"
};

/// The causes that explain most of what diverged, and with nothing contradicted; equals stand side by side. Empty where
/// no deviation explains anything.
struct CauseFindings {
    std::uint64_t divergent = 0; ///< tried on
    std::vector<Cause> best;

    [[nodiscard]] bool explains_all() const {
        return !best.empty() && best.front().explained == divergent && best.front().contradicted == 0;
    }
};

/// Looks for the named deviation (reference/deviation.hpp) that explains divergence: each alone, then in pairs, on the
/// first frames with divergence; what explains all there is held against the frames that follow.
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
        std::vector<Cause> causes;
    };
    template <class Count, class Pairs>
    static void hold_against(Trial& trial, const std::vector<std::size_t>& divergent, std::vector<Cause> singles,
                             const Count& count, const Pairs& pairs);
    void try_on_particles(const JudgedFrame& frame, const FrameVerdicts& verdicts, const FrameInputs& inputs);
    void try_on_texels(const JudgedFrame& frame, const FrameVerdicts& verdicts, const FrameInputs& inputs);
    static CauseFindings findings(const Trial& trial);

    Trial particles_, texels_;
};

} // namespace lockstep
