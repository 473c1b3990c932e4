#pragma once
#include <cstddef>

#include "gpu/program.hpp"

namespace lockstep {

/// Invocations in a group of a compute stage that makes one a particle: its local_size_x. Throws Error where the others
/// are not 1, or this context takes too few groups for that many particles.
std::size_t group_size(const Program& program, std::size_t particles);

/// Uses the program and makes one invocation a particle, to the end of the last group of `group`.
void dispatch_particles(const Program& program, std::size_t particles, std::size_t group);

} // namespace lockstep
