#pragma once
#include <vector>

#include "crosscheck/judge/system.hpp"

namespace lockstep::fluid {

/// The mistakes that have names.
const std::vector<NamedMistake>& mistakes();

} // namespace lockstep::fluid
