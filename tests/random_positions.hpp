#pragma once
#include <cstddef>
#include <random>
#include <vector>

#include <glm/vec3.hpp>

namespace lockstep::test {

/// In a cube round the origin.
inline std::vector<glm::vec3> random_positions(std::size_t count, float half_side, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> value(-half_side, half_side);
    std::vector<glm::vec3> positions(count);
    for (glm::vec3& p : positions)
        p = {value(random), value(random), value(random)};
    return positions;
}

} // namespace lockstep::test
