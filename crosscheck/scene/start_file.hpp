#pragma once
#include <filesystem>

#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/switches.hpp"

namespace lockstep {

/// The particles of a table (number_table.hpp): position, then direction and speed or velocity, and perhaps
/// collide_time, all finite; held as switch `velocity` says. Throws Error naming file and line.
Particles read_start(const std::filesystem::path& file, const Switches& switches);

/// Held as switch `velocity` says, where they have directions and speeds.
void hold_velocity(Particles& particles, const Switches& switches);

} // namespace lockstep
