#pragma once
#include "reference/collision/sites.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/readings/vector.hpp"

namespace lockstep {

/// A particle's state in a reading's numbers.
template <class R> struct ParticleTwinState {
    typename R::Vec3 position, direction;
    typename R::Real speed{}, collide_time{};
    auto fields() { return std::tie(position, direction, speed, collide_time); }
    auto fields() const { return std::tie(position, direction, speed, collide_time); }
};

/// What becomes of a particle once its search is done (thesis, Fig. 3-3, lines 20 to 30).
template <class R> class ParticleTwin {
    using Real = typename R::Real;
    using Vec3 = typename R::Vec3;

  public:
    using State = ParticleTwinState<R>;

    ParticleTwin(R& reading, const FrameParams& params)
        : r(reading), constants_(params.constants), switches_(params.switches) {}

    [[nodiscard]] State read(const ParticleState& before) const {
        return {r.read(site::position_before, before.position), r.read(site::direction_before, before.direction),
                r.read(site::speed_before, before.speed), r.read(site::collide_time_before, before.collide_time)};
    }

    /// Lines 21 to 24; `apart`: own position minus the one collided with.
    [[nodiscard]] State collide(const State& a, const Vec3& apart) const {
        const Real tick = r.uniform(site::tick, constants_.tick);
        const Vec3 away = r.note(site::away, apart);
        State v;
        const Real factor = r.uniform(site::speed_factor, switches_.speed_factor);
        const bool vector = is_vector();
        v.speed = r.note(site::speed_at_hit, vector ? a.speed : a.speed * factor);
        const Vec3 along = r.normalize(site::direction_at_hit, away);
        v.direction = r.note(site::direction_at_hit,
                             vector ? along * (r.length(site::direction_at_hit, a.direction) * factor) : along);
        v.collide_time = r.note(site::collide_time_at_hit, r.uniform(site::collision_time, constants_.collision_time));
        Vec3 step = r.note(site::moves_along, v.direction) * r.note(site::moves_by, v.speed);
        if (r.setting(site::step_by_tick, switches_.collision_step == CollisionStep::tick))
            step = step * tick;
        v.position = r.note(site::position_at_hit, a.position + step);
        return v;
    }

    /// Lines 26 to 30.
    [[nodiscard]] State integrate(const State& a) const {
        const Real tick = r.uniform(site::tick, constants_.tick);
        const Vec3 fall = r.note(site::fall, r.read(site::gravity, constants_.gravity) * tick);
        const Vec3 velocity = r.note(site::velocity, r.note(site::velocity_before, a.direction * a.speed) + fall);
        State v;
        const bool vector = is_vector();
        v.direction = r.note(site::direction, vector ? velocity : r.normalize(site::direction, velocity));
        v.speed = r.note(site::speed, vector ? a.speed : r.length(site::speed, velocity));
        v.collide_time = r.note(site::collide_time, a.collide_time - r.note(site::counted, tick));
        const Vec3 step = r.note(site::step, v.direction * v.speed);
        v.position = r.note(site::position, a.position + r.note(site::move, step * tick));
        return v;
    }

    /// By the listing's indentation, lines 9 to 30 belong to those that search.
    [[nodiscard]] State stand(const State& a) const {
        return {r.note(site::position_kept, a.position), r.note(site::direction_kept, a.direction),
                r.note(site::speed_kept, a.speed), r.note(site::collide_time_kept, a.collide_time)};
    }

  private:
    [[nodiscard]] bool is_vector() const { return switches_.velocity == Velocity::vector; }

    R& r;
    const Constants& constants_;
    const Switches& switches_;
};

} // namespace lockstep
