#pragma once
#include <string>

namespace lockstep {

/// What a process may still ask of the kernel, seccomp's filter: to read what it has open, to write to one descriptor,
/// memory that is not executable, its own limits and its end; `opening`: also to open files for reading. Whatever else
/// it asks fails with EPERM: to start programs or processes, to write, remove or rename files, to use the network, to
/// send signals. Fences add up, and none can be taken down again.
enum class Fence { opening, reading };

/// Gives why there is no fence, or an empty text.
std::string put_up_fence(Fence fence, int writable);

} // namespace lockstep
