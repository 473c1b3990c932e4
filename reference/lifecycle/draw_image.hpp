#pragma once
#include "reference/model/image.hpp"
#include "reference/model/lifecycle/drawing.hpp"

namespace lockstep::lifecycle {

/// The picture of such corners (drawn_schema) over `background`: opaque emitters, the nearest and, as near, the first;
/// then the others in the scene's order. Sprites are the scene's texture, else soft blobs, ribbons a pattern along u.
ColorImage draw_image(const Host& host, const SystemView& state, ColorImage background);

} // namespace lockstep::lifecycle
