#pragma once
#include <cstddef>

#include <nlohmann/json.hpp>

#include "crosscheck/report/page/blob.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// Particles a scene may have in the live view, whose start is part of the page.
inline constexpr std::size_t most_live_particles = 65'536;

/// Frames it holds against the reference, and frames it runs.
inline constexpr int most_checked_frames = 60;
inline constexpr int most_live_frames = 10'000;

/// What the page's live view (docs/live_view.md) needs to run a scene in a browser and to know whether it ran right.
struct LiveScene {
    /// Size, constants, and for each preset, and the scene's own switches where they are none, the shaders'
    /// definitions and the reference's state hashes after each of the first frames. A run in exact arithmetic has one
    /// reference, every other one for each profile. Only {"unavailable": reason} of a scene that WebGL2 cannot run.
    nlohmann::json head;

    /// As read by crosscheck/report_page/src/live/live_scene.js, each as Blob::words:
    ///   c n each            of n particles the fields, in the order of the schema, of c components
    ///   3 c, 3 t            obstacles: c corners, t triangles
    ///   16 f, 16 f, 16 f    of f frames: u_ProjView, render view, render projection
    Blob arrays;
};

/// References follow `profile` and the strict one.
LiveScene live_scene(const Scene& scene, int frames, const Profile& profile);

} // namespace lockstep
