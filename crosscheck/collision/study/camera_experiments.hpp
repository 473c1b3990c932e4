#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "reference/collision/search_study.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// The thesis's experiments with the collision camera (chapter 3.4) on a scene: moving with the viewer at several z
/// offsets (eq. 1, fig. 3-8), standing while the viewer walks round (fig. 3-9), at the side and behind (fig. 3-7).
struct CameraRow {
    std::string_view camera;     ///< the collision camera
    std::string_view viewer;     ///< the render camera
    float offset = 0.0F;         ///< world units along z
    SearchCounts counts;         ///< of all studied frames
    std::size_t seen = 0;        ///< particles in contact that own a pixel of the viewer's image
    std::size_t seen_missed = 0; ///< of these: those that find no neighbour, the holes that the viewer sees
    double hits = 0.0;           ///< particles a frame whose search ends at a particle or an obstacle
};

struct CameraOptions {
    int frames = 60;
    int every = 10;
    std::function<void(const CameraRow&)> on_row;
};

/// Runs the scene once for each camera, by the reference.
std::vector<CameraRow> camera_experiments(const Scene& scene, const Profile& profile, const CameraOptions& options);

std::string camera_head();
std::string camera_text(const CameraRow& row);

} // namespace lockstep
