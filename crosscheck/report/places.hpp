#pragma once
#include <string>

#include "crosscheck/judge/verdict_summary.hpp"

namespace lockstep {

/// "--frame 3 --texel 4,5", as `lockstep explain` takes it. `width`: of an image, texels.
std::string place_arguments(const Place& place, const Schema& schema, int width);

} // namespace lockstep
