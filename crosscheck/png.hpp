#pragma once
#include <filesystem>

#include "reference/model/image.hpp"

namespace lockstep {

/// Writes an 8-bit RGBA PNG, top row of the picture = last row of the image. Whole or not at all; Error if it fails.
void write_png(const std::filesystem::path& path, const ColorImage& image);

} // namespace lockstep
