#pragma once
#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

namespace lockstep {

/// State of all particles, one array a field; index i is particle i on both sides (spec, "State of a particle").
struct Particles {
    std::vector<glm::vec3> position;  ///< world units
    std::vector<glm::vec3> direction; ///< unit length after the first step
    std::vector<float> speed;         ///< world units a second
    std::vector<float> collide_time;  ///< seconds; a particle searches only while it is negative

    [[nodiscard]] std::size_t size() const { return position.size(); }
    void resize(std::size_t count) {
        position.resize(count);
        direction.resize(count);
        speed.resize(count);
        collide_time.resize(count);
    }
};

} // namespace lockstep
