#pragma once
#include <vector>

#include "crosscheck/judge/system.hpp"

namespace lockstep::lights {

/// Of the passes that light a point.
std::vector<NamedMistake> lighting_mistakes();

} // namespace lockstep::lights
