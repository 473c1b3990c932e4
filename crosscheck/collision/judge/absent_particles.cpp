#include "crosscheck/collision/judge/absent_particles.hpp"

#include <algorithm>
#include <limits>

namespace lockstep {

void AbsentParticles::hide(Particles& particles, std::size_t count) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const std::size_t present = std::min(count, particles.size());
    taken_.resize(particles.size() - present);
    for (std::size_t i = present; i < particles.size(); ++i) {
        taken_.set(i - present, particles[i]);
        particles.set(i, {glm::vec3(nan), glm::vec3(nan), nan, nan});
    }
}

void AbsentParticles::put_back(Particles& particles) const {
    const std::size_t present = particles.size() - taken_.size();
    for (std::size_t i = 0; i < taken_.size(); ++i)
        particles.set(present + i, taken_[i]);
}

} // namespace lockstep
