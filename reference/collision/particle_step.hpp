#pragma once
#include <glm/vec3.hpp>

#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// What becomes of a particle once its search is done (thesis, Fig. 3-3, lines 20 to 30). `A`: arithmetic.hpp; the
/// particle's state has been through `flushed`.
template <class A> struct ParticleStep {
    A fp;
    const Constants& constants;
    const Switches& switches;

    ParticleStep(A fp_, const FrameParams& params) : fp(fp_), constants(params.constants), switches(params.switches) {}

    [[nodiscard]] ParticleState flushed(const ParticleState& a) const {
        return {fp.flush(a.position), fp.flush(a.direction), fp.flush(a.speed), fp.flush(a.collide_time)};
    }

    /// Lines 21 to 24; `away`: own position minus the one collided with.
    [[nodiscard]] ParticleState collide(const ParticleState& a, glm::vec3 away) const {
        ParticleState v;
        v.speed = fp.flush(a.speed * switches.speed_factor);
        v.direction = fp.normalize(away);
        v.collide_time = constants.collision_time;
        glm::vec3 step = fp.scale(v.direction, v.speed);
        if (switches.collision_step == CollisionStep::tick)
            step = fp.scale(step, constants.tick);
        v.position = fp.flush(a.position + step);
        return v;
    }

    /// Lines 26 to 30.
    [[nodiscard]] ParticleState integrate(const ParticleState& a) const {
        const glm::vec3 temp = fp.flush(fp.scale(a.direction, a.speed) + fp.scale(constants.gravity, constants.tick));
        ParticleState v;
        v.direction = fp.normalize(temp);
        v.speed = fp.length(temp);
        v.collide_time = fp.flush(a.collide_time - constants.tick);
        v.position = fp.flush(a.position + fp.scale(fp.scale(v.direction, v.speed), constants.tick));
        return v;
    }
};

} // namespace lockstep
