#pragma once
#include <span>

#include <glm/mat4x4.hpp>

#include "reference/model/image.hpp"
#include "reference/model/overlay_line.hpp"

namespace lockstep {

/// Draws lines a pixel wide over what is there, as `to_clip` sees them; what lies behind the camera is left out.
void draw_overlay(ColorImage& image, const glm::mat4& to_clip, std::span<const OverlayLine> lines);

} // namespace lockstep
