#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "crosscheck/text/witness.hpp"
#include "gpu/shader_source.hpp"

namespace lockstep {

/// A stage of the user's and the reference's in its place.
struct StagePair {
    std::shared_ptr<const ShaderSource> own, reference;
};

/// Runs a host with the user's shaders, or with the reference's. It makes the programs, and calls look() before what is
/// to be looked at.
using RunStages = std::function<void(bool with_reference, const std::function<void()>& look)>;

/// Lines of the user's stages that have no counterpart in the reference's, of what GL runs: both texts run from what GL
/// had bound to the user's, and with its inputs. Uniforms that this has not are those of the reference's own run. The
/// first dispatch or draw of each stage counts in which the texts differ more than theirs leave open. In the current
/// context; none where that is older than GL 4.3, or where the stages' interfaces differ.
std::vector<WitnessLine> lines_of_stages(const std::vector<StagePair>& stages, const RunStages& run);

} // namespace lockstep
