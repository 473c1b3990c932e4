#pragma once
#include <cstddef>

namespace lockstep {

/// Seconds that glCopyBufferSubData takes from one buffer into another, by the GPU's own clock: what a pass that reads
/// and writes as many bytes cannot be faster than.
double copy_seconds(std::size_t bytes);

} // namespace lockstep
