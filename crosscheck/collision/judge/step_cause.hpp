#pragma once
#include <vector>

#include "crosscheck/collision/judge/verdict.hpp"
#include "crosscheck/judge/cause_findings.hpp"
#include "crosscheck/judge/item_cause.hpp"
#include "crosscheck/judge/joint_cause.hpp"
#include "crosscheck/judge/system.hpp"
#include "reference/collision/deviation.hpp"
#include "reference/collision/frame_inputs.hpp"

namespace lockstep {

/// The mistakes with names (reference/collision) of the particles' step, in any pass that makes it.
std::vector<NamedMistake> named_mistakes(const Scene& scene, const Profile& profile);

/// Looks for the deviations (reference/collision/deviation.hpp) that explain what the listing's pass draws wrongly.
class TexelCauses {
  public:
    TexelCauses();

    /// The evidence of a frame with divergence. `inputs` as the frame ran, its drawn_cdt the GPU's.
    void add(const JudgedFrame& frame, const FrameVerdicts& verdicts, const FrameInputs& inputs);

    [[nodiscard]] CauseFindings findings() const { return causes_.findings(); }

  private:
    JointCauses causes_;
};

/// The evidence of a frame with divergence, on what the particles' step made and, with the listing's, drew.
void add_causes(const JudgedFrame& frame, const FrameVerdicts& verdicts, const FrameInputs& inputs,
                ItemCauseFinder& of_step, TexelCauses& of_texels);

} // namespace lockstep
