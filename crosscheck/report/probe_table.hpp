#pragma once
#include <string>

#include "gpu/probe.hpp"

namespace lockstep {

/// The rows as a person reads them: name, finding, inputs matched, largest distance. Where no candidate explains every
/// input, the closest ones are listed below.
std::string probe_table(const ProbeResult& result);

} // namespace lockstep
