#pragma once
#include <functional>
#include <string>
#include <vector>

#include "reference/model/collision/scene.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

inline constexpr float rest_speed = 0.02F; ///< world units a second; who is slower is at rest

/// Who has come to rest after some frames, and where (thesis, figs 4-1, 4-2, 6-4 and 6-5). Heights are over the lowest
/// point of the scene's obstacles, which is the plane where there is one.
struct RestFrame {
    int frames = 0;       ///< run so far
    double hits = 0.0;    ///< particles that hit in the last of them, of all
    double moving = 0.0;  ///< of all, those whose position changed in it
    double above = 0.0;   ///< particles over that point, of all
    double at_rest = 0.0; ///< of all, those above that are slower than rest_speed
    double middle = 0.0;  ///< height under which half of those at rest lie; 0 without any
    double top = 0.0;     ///< the same of 99 in 100
};

struct RestOptions {
    int frames = 600;
    int every = 120;
    std::function<void(const RestFrame&)> on_frame;
};

/// Runs the scene by the reference; a row after each `every` frames. Throws Error where it has no obstacles.
std::vector<RestFrame> rest_run(const Scene& scene, const Profile& profile, const RestOptions& options);

std::string rest_head();
std::string rest_text(const RestFrame& row);

} // namespace lockstep
