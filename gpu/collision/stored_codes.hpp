#pragma once
#include <functional>

#include "gpu/gl.hpp"
#include "reference/model/collision/switches.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// The GL format that stores the codes of a CDT.
GLenum stored_format(CdtFormat format);

/// Hand an image's codes to `transfer(type, codes)` as GL stores them, or take them from it: four components a texel,
/// halves and bytes as such, so that no driver's conversion is in the way.
void upload_codes(const CollisionImage& image, CdtFormat format,
                  const std::function<void(GLenum type, const void* codes)>& transfer);
void read_codes(CollisionImage& image, CdtFormat format, const std::function<void(GLenum type, void* codes)>& transfer);

} // namespace lockstep
