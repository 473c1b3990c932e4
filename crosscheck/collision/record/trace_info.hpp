#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crosscheck/judge/legal.hpp"
#include "reference/known_operations.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// What a trace says of its run besides the states.
struct TraceInfo {
    Scene scene;                    ///< complete: its start is the trace's first row
    std::optional<Profile> profile; ///< as measured when the run was recorded; not set: nobody did
    std::string renderer;           ///< renderer, version, context
    std::string settings;           ///< preset and changed switches, as a report tells them
    std::string shaders;            ///< whose ran, as a report tells it; empty: not told
    std::string probe;              ///< what `lockstep probe --json` writes; may be empty
    bool has_cdt = false;
    std::vector<std::uint32_t> counts; ///< of each frame how many particles there are; empty: all, in every frame

    // What the reader adds.
    std::string file;                  ///< where it lies
    std::string program;               ///< what wrote it, with its version
    int frames = 0;                    ///< whole ones
    std::vector<std::string> warnings; ///< what was left out, and why
};

/// What the reference follows: the recorded profile, or strict.
Profile followed_profile(const TraceInfo& info);

/// What a difference is judged by; where nothing was measured, GLSL's rules.
KnownOperations known_operations(const TraceInfo& info, Legal legal = Legal::measured);

/// What a report on the trace has to say besides: warnings, and what the trace cannot prove.
std::vector<std::string> notes_on(const TraceInfo& info);

} // namespace lockstep
