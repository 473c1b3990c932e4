#pragma once
#include <optional>
#include <span>

#include "reference/lifecycle/sites.hpp"
#include "reference/model/lifecycle/host.hpp"
#include "reference/system/force_fields.hpp"

namespace lockstep::lifecycle {

/// What accelerates a particle. Twin of shaders/lifecycle/forces.glsl.
template <class R> class Forces {
    using Real = typename R::Real;
    using Vec3 = typename R::Vec3;

  public:
    struct Motion {
        Vec3 acceleration;
        Vec3 drift;      ///< a velocity that moves the particle and is not kept
        Real drag{1.0F}; ///< what is left of the velocity
        bool killed = false;
        std::optional<Vec3> position = {}, velocity = {}; ///< of a graph that gives them
    };

    Forces(R& reading, const Switches& switches) : r(reading), switches_(switches) {}

    /// `m`: without these forces.
    Motion motion(std::span<const HostForce> forces, const Vec3& p, const Vec3& v, Motion m) const {
        for (const HostForce& force : forces)
            switch (force.kind) {
            case Force::Kind::drag:
                if (switches_.drag == Drag::explicit_force)
                    m.acceleration =
                        m.acceleration - r.note(site::drag, v * r.uniform(site::drag_coefficient, force.drag));
                else
                    m.drag = m.drag * r.uniform(site::drag_factor, force.drag);
                break;
            case Force::Kind::vortex:
                vortex(m, force, p);
                break;
            case Force::Kind::attraction:
                attraction(m, force, p);
                break;
            case Force::Kind::curl_noise: {
                const Vec3 w = curl_noise(force, p);
                if (switches_.curl_use == CurlUse::force)
                    m.acceleration = m.acceleration + w;
                else
                    m.drift = m.drift + w;
            }
            }
        return m;
    }

  private:
    int exponent(const HostForce& force) const {
        return static_cast<int>(r.uniform(site::exponent, static_cast<int>(force.falloff)));
    }

    void vortex(Motion& m, const HostForce& force, const Vec3& p) const {
        const Vortex<R> one{r.uniform(site::centre, force.centre),     r.uniform(site::axis, force.axis),
                            r.uniform(site::strength, force.strength), r.uniform(site::reach, force.radius),
                            r.uniform(site::pull, force.pull),         exponent(force)};
        m.acceleration = one.added(r, m.acceleration, p);
    }

    void attraction(Motion& m, const HostForce& force, const Vec3& p) const {
        const Vec3 way = r.note(site::to_centre, r.uniform(site::centre, force.centre) - p);
        const Real l = r.note(site::distance, r.length(site::distance, way));
        if (r.decide(site::is_killed, l < r.uniform(site::pull, force.pull)))
            m.killed = true;
        const bool inverse_square = !(force.square < 0.0F);
        const Attraction<R> one{r.uniform(site::strength, force.strength), r.uniform(site::reach, force.radius),
                                r.uniform(site::softening, force.square), inverse_square ? 0 : exponent(force),
                                inverse_square};
        m.acceleration = one.added(r, m.acceleration, way, l);
    }

    Vec3 curl_noise(const HostForce& force, const Vec3& p) const {
        const Vec3 x = r.note(site::noise_place,
                              p * r.uniform(site::frequency, force.radius) + r.uniform(site::offset, force.centre));
        return lockstep::curl_noise(r, x, r.uniform(site::strength, force.strength),
                                    static_cast<std::uint32_t>(force.seed),
                                    switches_.curl_derivative == CurlDerivative::difference);
    }

    R& r;
    const Switches& switches_;
};

} // namespace lockstep::lifecycle
