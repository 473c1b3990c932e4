#pragma once
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "crosscheck/files/json_reader.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// A scene's "clip_space" and "frames" (data/scenes/README.md). Throw Error as JsonValue does.
ClipSpace read_clip_space(const JsonValue& json, const Switches& switches);

/// `scene`: its switches and constants hold where a frame names none.
std::vector<FrameSettings> read_frames(const JsonValue& json, const Scene& scene);

/// Of these sorted settings those that hold in a frame or in the one before.
std::vector<FrameSettings> settings_near(std::vector<FrameSettings> frames, int frame);

nlohmann::json clip_space_json(const ClipSpace& space);
nlohmann::json frames_json(const Scene& scene);

} // namespace lockstep
