#pragma once
#include "reference/model/image.hpp"

namespace lockstep {

/// Where two pictures of one size differ, in red on a dimmed copy of the first.
ColorImage difference_picture(const ColorImage& reference, const ColorImage& gpu);

} // namespace lockstep
