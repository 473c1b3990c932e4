#pragma once
#include <vector>

#include "crosscheck/judge/system.hpp"

namespace lockstep::lifecycle {

/// Mistakes that people make in these passes, with their names.
const std::vector<NamedMistake>& mistakes();

} // namespace lockstep::lifecycle
