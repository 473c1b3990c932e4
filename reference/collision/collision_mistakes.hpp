#pragma once
#include <optional>

#include "reference/deviation.hpp"
#include "reference/readings/mistake.hpp"

namespace lockstep {

/// What a named deviation is at the sites of the collision twin; nothing where it is not the step's mistake but its
/// host's or its arithmetic's, or shows in drawing only.
std::optional<Mistake> step_mistake(Deviation deviation);

} // namespace lockstep
