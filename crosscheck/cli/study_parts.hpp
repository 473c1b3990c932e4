#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/command/verb.hpp"

namespace lockstep {

/// What every study of a scene is told.
struct StudiedScene {
    RunOptions run;
    int every = 1;
    std::string profile = "strict";
};

/// Scene, frames, `every` and profile.
void add_studied_scene(Verb& verb, StudiedScene& studied, SceneArgument scene = SceneArgument::required);

/// Throw Error: where there is one frame alone, whose CDT is empty; where the scene draws no particles into a CDT.
void check_frames(const StudiedScene& studied);
void check_has_cdt(const Scene& scene);

/// The folder of a study's own scenes: that of the option, else the shipped one.
void add_scenes_option(Verb& verb, std::filesystem::path& scenes);
std::filesystem::path scenes_or_shipped(const std::filesystem::path& scenes);

/// rest, cameras, recall, catalogue, remedies.
std::vector<Verb> study_parts();

} // namespace lockstep
