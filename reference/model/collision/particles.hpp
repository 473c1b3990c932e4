#pragma once
#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

#include "reference/model/same_bits.hpp"

namespace lockstep {

/// State of one particle.
struct ParticleState {
    glm::vec3 position{0.0F};
    glm::vec3 direction{0.0F};
    float speed = 0.0F;
    float collide_time = 0.0F;
};

/// The same bits, or both NaN, in every component.
inline bool same_bits(const ParticleState& a, const ParticleState& b) {
    return same_bits(a.position, b.position) && same_bits(a.direction, b.direction) && same_bits(a.speed, b.speed) &&
           same_bits(a.collide_time, b.collide_time);
}

/// State of all particles, one array a field; index i is particle i on both sides (spec, "State of a particle").
struct Particles {
    std::vector<glm::vec3> position;  ///< world units
    std::vector<glm::vec3> direction; ///< unit length after the first step
    std::vector<float> speed;         ///< world units a second
    std::vector<float> collide_time;  ///< seconds; a particle searches only while it is negative

    [[nodiscard]] std::size_t size() const { return position.size(); }
    [[nodiscard]] ParticleState operator[](std::size_t i) const {
        return {position[i], direction[i], speed[i], collide_time[i]};
    }
    void set(std::size_t i, const ParticleState& state) {
        position[i] = state.position;
        direction[i] = state.direction;
        speed[i] = state.speed;
        collide_time[i] = state.collide_time;
    }
    void resize(std::size_t count) {
        position.resize(count);
        direction.resize(count);
        speed.resize(count);
        collide_time.resize(count);
    }
};

} // namespace lockstep
