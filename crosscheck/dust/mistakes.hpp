#pragma once
#include <vector>

#include "crosscheck/judge/system.hpp"

namespace lockstep::dust {

/// Mistakes that people make in these kernels, with their names.
const std::vector<NamedMistake>& mistakes();

} // namespace lockstep::dust
