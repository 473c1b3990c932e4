#pragma once
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace lockstep {

/// A direction of length 1, and two across it and each other. Made in double, rounded once.
struct Basis {
    glm::vec3 ahead{0.0F, 1.0F, 0.0F}, side{1.0F, 0.0F, 0.0F}, up{0.0F, 0.0F, 1.0F};
};

/// `direction` has a length.
inline Basis basis_of(const glm::vec3& direction) {
    const glm::dvec3 ahead = glm::normalize(glm::dvec3(direction));
    const glm::dvec3 other = std::abs(ahead.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 across = glm::normalize(glm::cross(other, ahead));
    return {glm::vec3(ahead), glm::vec3(across), glm::vec3(glm::cross(ahead, across))};
}

/// 1 - cos of an angle in degrees.
inline float depth_of_cone(float degrees) {
    return static_cast<float>(1.0 - std::cos(double{degrees} * 3.14159265358979323846 / 180.0));
}

} // namespace lockstep
