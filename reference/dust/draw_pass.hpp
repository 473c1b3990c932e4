#pragma once
#include <memory>

#include "reference/model/dust/drawing.hpp"
#include "reference/model/image.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep::dust {

/// The vertex stage that draws the grains, as a pass that makes the corners of drawn_schema().
std::unique_ptr<ItemPass> draw_pass(const HostPtr& host, const Drawing& drawing);

/// The picture of such corners over `background`: triangles in the order of the grains, each blended by its alpha.
ColorImage draw_image(const SystemView& state, Mesh mesh, ColorImage background);

} // namespace lockstep::dust
