#pragma once
#include <functional>

#include "crosscheck/collision/judge/verdict.hpp"
#include "crosscheck/judge/check.hpp"
#include "crosscheck/judge/compare.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

class GpuSide;

/// Both sides after one frame, and what their comparison said.
struct ComparedFrame {
    int frame = 0;
    const Particles& reference;
    const CollisionImage& reference_cdt;
    const Particles& gpu;
    const CollisionImage& gpu_cdt;
    const Comparison& comparison;
    const FrameVerdicts* verdicts = nullptr; ///< null where nothing differs, or differences are not judged
};

struct FrameCheckOptions : CheckOptions {
    FrameCheckOptions() = default;
    FrameCheckOptions(const CheckOptions& options) : CheckOptions(options) {} // NOLINT: nothing more is asked for

    /// Called after each comparison (hash files, images, traces).
    std::function<void(const ComparedFrame&)> on_state;

    Particles* last_start = nullptr; ///< set: becomes the GPU's particles that the last frame started from
};

/// Runs both sides from the scene's start and compares every float of every frame. Throws Error when the run would
/// prove nothing: a GL error, an incomplete framebuffer, output that was not written, no frame compared.
CheckReport check(const Scene& scene, const Profile& profile, GpuSide& gpu, const FrameCheckOptions& options);

/// The same in two steps, between which reports on parts of one run can be joined (crosscheck/judge/joined_parts.hpp).
CheckReport judge_frames(const Scene& scene, const Profile& profile, GpuSide& gpu, const FrameCheckOptions& options);
void conclude(CheckReport& report);

} // namespace lockstep
