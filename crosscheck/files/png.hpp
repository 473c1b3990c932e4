#pragma once
#include <string>

#include "reference/model/image.hpp"

namespace lockstep {

/// An 8-bit RGBA PNG file; top row of the picture = last row of the image. Throws Error if the image is empty.
std::string png(const ColorImage& image);

} // namespace lockstep
