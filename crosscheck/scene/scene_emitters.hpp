#pragma once
#include <vector>

#include "crosscheck/files/json_reader.hpp"
#include "reference/model/collision/emitters.hpp"

namespace lockstep {

/// The emitters of a scene, at least one, of up to most_particles together. Throws Error as load_scene does.
std::vector<Emitter> read_emitters(const JsonValue& json);

} // namespace lockstep
