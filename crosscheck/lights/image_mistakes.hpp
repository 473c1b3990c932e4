#pragma once
#include <vector>

#include "crosscheck/judge/system.hpp"

namespace lockstep::lights {

/// Of the passes that draw the obstacles and the glows, and make codes of the image.
std::vector<NamedMistake> image_mistakes();

} // namespace lockstep::lights
