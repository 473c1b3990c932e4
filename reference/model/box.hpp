#pragma once
#include <glm/vec3.hpp>

namespace lockstep {

/// An axis-aligned box, world units.
struct Box {
    glm::vec3 min{-1.0F};
    glm::vec3 max{1.0F};
};

} // namespace lockstep
