#pragma once
#include <functional>
#include <span>
#include <vector>

#include "reference/collision/search_study.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

class GpuSimulation;

/// A frame of a study.
struct StudyFrame {
    int frame = 0;
    SearchCounts counts;
    Drift drift;
};

/// What a studied frame's pictures need.
struct StudiedState {
    int frame;
    const Particles& particles; ///< before the step
    const FrameParams& params;
    std::span<const Finding> findings;
};

struct StudyOptions {
    int frames = 60;
    int every = 1;                                     ///< studies frames 1, 1 + every, ...; frame 0 has an empty CDT
    std::function<void(int done)> on_frame;            ///< after each frame, studied or not
    std::function<void(const StudiedState&)> on_state; ///< of each studied frame
};

/// Runs the reference and studies its searches.
std::vector<StudyFrame> study_run(const Scene& scene, const Profile& profile, const StudyOptions& options);

/// The same of the GL side; `profile`: what its driver computes.
std::vector<StudyFrame> study_run(const Scene& scene, const Profile& profile, GpuSimulation& gpu,
                                  const StudyOptions& options);

/// The study of a scene's start: drawn once as it stands, then every particle searches. `truth` of the start.
SearchStudy study_start(const Scene& scene, const TrueNeighbours& truth, const Profile& profile);
SearchStudy study_start(const Scene& scene, const Profile& profile);

} // namespace lockstep
