#pragma once
#include <vector>

#include "crosscheck/judge/system.hpp"

namespace lockstep::lights {

/// Of the passes that add lights up, sort them before and read the sums after.
std::vector<NamedMistake> volume_mistakes();

} // namespace lockstep::lights
