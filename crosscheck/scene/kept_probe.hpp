#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "gpu/probe.hpp"

namespace lockstep {

/// Everything that what a driver computes may depend on, as a digest: this program and each library that is loaded now
/// (size and time of change), what the context says of itself, the processor and how many of its cores are free, the
/// kernel and its GPU driver, the drivers' settings files, and the environment, apart from variables that only name
/// folders, terminals and sessions. `context` is current.
std::string probe_key(const Context& context);

/// Where results are kept: $LOCKSTEP_CACHE, else lockstep in $XDG_CACHE_HOME or ~/.cache. None where LOCKSTEP_CACHE is
/// `off`, where there is no such folder and none can be made, and where another user owns it or can write to it.
std::optional<std::filesystem::path> probe_folder();

/// probe(context), or its result of an earlier process with the same key. A file that is damaged, and one that cannot
/// be written, count for nothing: the driver is measured. The newest 32 results stay.
ProbeResult kept_probe(const Context& context);

} // namespace lockstep
