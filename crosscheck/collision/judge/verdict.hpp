#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "crosscheck/judge/item_verdict.hpp"
#include "reference/collision/legal_outcomes.hpp"
#include "reference/known_operations.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"
#include "reference/model/mesh.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

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
    bool particles_differ = true; ///< false: they were compared, and every bit agrees
    /// Where the reference draws the GPU's particles (DrawnFrame); empty: to be found.
    std::span<const std::int32_t> texels_of_points = {};
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
