#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "crosscheck/collision/judge/verdict.hpp"
#include "crosscheck/collision/report/explain_text.hpp"
#include "gpu/collision/collision_trace.hpp"
#include "reference/known_operations.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// One particle's step in one frame of a run, with all that its verdict rests on and nothing else: what it started
/// from, the texels it may look at, what the GPU made of it, switches, constants, and what was measured of the driver.
/// Judged anywhere, without GL and without the run.
struct Capsule {
    Scene scene; ///< without particles and obstacles, which no step reads
    std::string renderer;
    std::string settings; ///< preset and changed switches
    int frame = 0;
    std::size_t particle = 0; ///< its number in the run
    Profile profile;          ///< of the driver's tables only the values that the verdict needs, NaN elsewhere
    KnownOperations known;
    ParticleState before, gpu;
    CollisionImage cdt; ///< empty but for the texels that may be looked at
    /// With search = octree, what the particle's leaf holds within reach, but for itself, in the leaf's order.
    std::vector<glm::vec3> entries;
    StepCapture capture; ///< what the GPU computed on its way; of a recorded run it tells only the new state
};

/// Where a capsule is cut from.
struct CapsuleSource {
    const Scene& scene;
    std::string renderer;
    std::string settings;
    int frame = 0;
    std::size_t particle = 0;
    StepCapture capture;
};

/// Throws Error where its file would be larger, as far as its texels show, and where the verdict of the capsule alone
/// would be another than the run's.
Capsule cut_capsule(const JudgedFrame& frame, const CapsuleSource& source);

/// What `lockstep capsule show` prints: where it is from, the step table, the verdict with all legal outcomes.
std::string capsule_text(const Capsule& capsule, NumberFormat format);

struct CapsuleVerdict {
    bool differs = false;
    ItemVerdict verdict; ///< where it differs
};
CapsuleVerdict judge(const Capsule& capsule);

} // namespace lockstep
