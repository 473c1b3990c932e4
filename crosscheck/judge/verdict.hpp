#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "crosscheck/judge/lean.hpp"
#include "reference/known_operations.hpp"
#include "reference/legal_outcomes.hpp"
#include "reference/model/image.hpp"
#include "reference/model/mesh.hpp"
#include "reference/model/particles.hpp"
#include "reference/model/profile.hpp"
#include "reference/model/scene.hpp"

namespace lockstep {

/// What a particle or texel that is not bit-equal is; exactly one of these.
enum class DifferenceClass {
    rounding,  ///< the same decisions; every field inside the interval that GLSL's precision rules allow
    tie,       ///< another decision that rounding can take
    undefined, ///< rests on what GL leaves open
    divergent, ///< no legal run explains it
};
inline constexpr std::array<std::string_view, 4> class_names{"rounding", "tie", "undefined", "divergent"};

/// One frame of a resync run: what it started from, and what both sides made of it. Refers to the run's own data.
struct JudgedFrame {
    const Mesh& obstacles;
    const FrameParams& params;
    const Profile& profile;
    const KnownOperations& known;
    const Particles& before;
    const CollisionImage& cdt; ///< read by the step
    const Particles& reference;
    const CollisionImage& reference_cdt; ///< drawn by the step
    const Particles& gpu;
    const CollisionImage& gpu_cdt;
};

struct ItemVerdict {
    std::size_t index = 0; ///< particle, or texel counted row by row from the bottom
    DifferenceClass kind = DifferenceClass::divergent;
    std::size_t outcomes = 1; ///< legal ones
    std::optional<Tie> tie = std::nullopt;
    Undefined undefined = Undefined::none;
    bool follows_particle = false;           ///< a texel that holds what the GPU's own particles leave there
    std::optional<Lean> lean = std::nullopt; ///< of a texel that is a tie or divergent, where a shift would explain it
};

/// Verdicts on what differs in a frame, by index.
struct FrameVerdicts {
    std::vector<ItemVerdict> particles;
    std::vector<ItemVerdict> texels;
};

/// Judges every particle and texel that is not bit-equal. A particle is legal when all of its fields lie in one outcome
/// of legal_outcomes. A texel is legal when it holds what one of its legal owners stores, taking particles where the
/// GPU's own state has them, each point on one texel; one that only differs because particles that do were drawn there
/// has the worst of their classes.
FrameVerdicts judge(const JudgedFrame& frame);

/// The verdict on one particle, whether it differs or not.
ItemVerdict judge_particle(const JudgedFrame& frame, std::size_t particle);

/// The CDT the reference draws of the GPU's particles.
CollisionImage redraw(const JudgedFrame& frame);

} // namespace lockstep
