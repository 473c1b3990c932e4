#pragma once
#include <vector>

#include "crosscheck/judge/system.hpp"

namespace lockstep::dust {

/// Mistakes that people make in the stage that draws grains, with their names.
const std::vector<NamedMistake>& drawing_mistakes();

} // namespace lockstep::dust
