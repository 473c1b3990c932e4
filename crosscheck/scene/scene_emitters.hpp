#pragma once
#include <cstddef>
#include <vector>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "reference/model/collision/emitters.hpp"

namespace lockstep {

/// The emitters of a scene, at least one, of up to `most` particles together. Throws Error as load_scene does.
std::vector<Emitter> read_emitters(const JsonValue& json, std::size_t most = most_particles);

} // namespace lockstep
