#pragma once
#include <glm/vec3.hpp>

#include "reference/model/image.hpp"

namespace lockstep {

/// A line in the world, on top of a picture.
struct OverlayLine {
    glm::vec3 from{0.0F}, to{0.0F};
    Rgba8 colour;
};

} // namespace lockstep
