#pragma once
#include <string>
#include <string_view>

#include "reference/model/image.hpp"

namespace lockstep {

/// An 8-bit RGBA PNG file; top row of the picture = last row of the image. Throws Error if the image is empty.
std::string png(const ColorImage& image);

/// The picture of a PNG file's bytes, 8-bit RGBA whatever it holds; its top row is the last one. Throws Error, with
/// `name`, where it is none, is damaged, or has more than `largest` pixels along a side.
ColorImage read_png(std::string_view bytes, const std::string& name, int largest);

} // namespace lockstep
