#pragma once
#include "reference/dust/cone.hpp"
#include "reference/dust/handed.hpp"

namespace lockstep {
struct FastRun;
}

namespace lockstep::dust {

/// Pulls what is in the cone to the mouth, where it dies. Twin of shaders/dust/vacuum_up.comp.
struct VacuumUpTwin {
    HostPtr host;
    FrameValues values = {}; ///< of the frame

    [[nodiscard]] VacuumUpTwin at(int frame) const { return {host, host->at(frame)}; }
    [[nodiscard]] VacuumUpTwin handed(std::span<const Mistake> made) const {
        return {host, dust::handed(*host, values, made)};
    }

    [[nodiscard]] bool fast(const FastRun& run) const;

    template <class R, class Item> Grain<R> operator()(R& r, const PassInput& in, const Item& item) const {
        Grain<R> grain = grain_before(r, in, item);
        if (!is_alive(r, grain))
            return grain;
        const ConeTwin<R> cone(r, *host, values);
        if (host->switches().suction == Suction::force_kernel)
            pull(r, grain, cone);
        else
            step(r, grain, cone);
        grain.velocity = r.note(site::velocity, grain.velocity);
        grain.position = r.note(site::position, grain.position);
        grain.alive = r.note(site::alive, grain.alive);
        return grain;
    }

  private:
    template <class R> void pull(R& r, Grain<R>& grain, const ConeTwin<R>& cone) const {
        const auto force = cone.force(grain.position);
        if (!force)
            return;
        const auto dt = r.uniform(site::dt, values.dt);
        const auto a = r.note(site::acceleration,
                              divided(r, site::acceleration, *force, r.uniform(site::mass, host->settings().mass)));
        grain.velocity = r.note(site::pulled, grain.velocity + r.note(site::impulse, a * dt));
        const auto next = r.note(site::forecast, grain.position + grain.velocity * dt);
        if (cone.kills(grain.position, next))
            grain.alive = 0;
    }

    /// The versions that move positions, not velocities.
    template <class R> void step(R& r, Grain<R>& grain, const ConeTwin<R>& cone) const {
        using Real = typename R::Real;
        const Suction suction = host->switches().suction;
        const auto way = r.note(site::to_mouth, cone.mouth() - grain.position);
        const Real d2 = r.note(site::sqr_dist, squared(way));
        if (r.decide(site::dies_at_once, d2 < cone.sqr_death())) {
            grain.alive = 0;
            return;
        }
        if (!r.decide(site::in_range, d2 < cone.sqr_range()))
            return;
        const auto dt = r.uniform(site::dt, values.dt);
        if (suction == Suction::lerp) {
            const float force = values.tool == nullptr ? 0.0F : values.tool->force;
            const Real share = dt * r.uniform(site::cleaner_force, force);
            grain.position = lerp(grain.position, cone.mouth(), r.note(site::share, r.min(r.max(share, 0.0F), 1.0F)));
            return;
        }
        const auto n = r.note(site::to_mouth_unit, unit(r, way));
        const Real pull = r.note(site::pull, r.divide(site::pull, dt * cone.sqr_force(), d2));
        if (suction == Suction::step) {
            grain.position = grain.position + n * pull;
            return;
        }
        const Real k = r.note(site::along, r.dot(site::along, cone.axis(), -n));
        if (!r.decide(site::in_cone, k > cone.threshold()))
            return;
        grain.position = grain.position + (n * pull) * k;
        if (r.decide(site::overshot, r.dot(site::overshot, cone.mouth() - grain.position, n) < 0.0F))
            grain.alive = 0;
    }

    template <class R> typename R::Vec3 unit(R& r, const typename R::Vec3& way) const {
        if (host->switches().unit == Unit::glsl)
            return r.normalize(site::to_mouth_unit, way);
        const auto length = r.note(site::length, r.sqrt(site::length, squared(way)));
        if (!r.decide(site::too_short, length > 1e-5F))
            return {};
        return divided(r, site::to_mouth_unit, way, length);
    }
};

} // namespace lockstep::dust
