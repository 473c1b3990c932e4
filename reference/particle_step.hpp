#pragma once
#include <glm/vec3.hpp>

#include "reference/model/particles.hpp"
#include "reference/model/scene.hpp"

namespace lockstep {

/// What becomes of a particle once its search is done (thesis, Fig. 3-3, lines 20 to 30). `A`: arithmetic.hpp; the
/// particle's state has been through A::flush.
template <class A> struct ParticleStep {
    const Constants& constants;
    const Switches& switches;

    explicit ParticleStep(const FrameParams& params) : constants(params.constants), switches(params.switches) {}

    static ParticleState flushed(const ParticleState& a) {
        return {A::flush(a.position), A::flush(a.direction), A::flush(a.speed), A::flush(a.collide_time)};
    }

    /// Lines 21 to 24; `away`: own position minus the one collided with.
    [[nodiscard]] ParticleState collide(const ParticleState& a, glm::vec3 away) const {
        ParticleState v;
        v.speed = A::flush(a.speed * switches.speed_factor);
        v.direction = A::normalize(away);
        v.collide_time = constants.collision_time;
        glm::vec3 step = A::scale(v.direction, v.speed);
        if (switches.collision_step == CollisionStep::tick)
            step = A::scale(step, constants.tick);
        v.position = A::flush(a.position + step);
        return v;
    }

    /// Lines 26 to 30.
    [[nodiscard]] ParticleState integrate(const ParticleState& a) const {
        const glm::vec3 temp = A::flush(A::scale(a.direction, a.speed) + A::scale(constants.gravity, constants.tick));
        ParticleState v;
        v.direction = A::normalize(temp);
        v.speed = A::length(temp);
        v.collide_time = A::flush(a.collide_time - constants.tick);
        v.position = A::flush(a.position + A::scale(A::scale(v.direction, v.speed), constants.tick));
        return v;
    }
};

} // namespace lockstep
