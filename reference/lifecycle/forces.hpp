#pragma once
#include <span>

#include "reference/lifecycle/noise.hpp"
#include "reference/model/lifecycle/host.hpp"

namespace lockstep::lifecycle {

template <class Vec> Vec cross_of(const Vec& a, const Vec& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

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
    };

    Forces(R& reading, const Switches& switches) : r(reading), switches_(switches) {}

    Motion motion(std::span<const HostForce> forces, const Vec3& p, const Vec3& v, const Vec3& a) const {
        Motion m{a, {}};
        for (const HostForce& force : forces)
            switch (force.kind) {
            case Force::Kind::drag:
                if (switches_.drag == Drag::explicit_force)
                    m.acceleration = m.acceleration - r.note(site::drag, v * r.uniform(site::drag_factor, force.drag));
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
    Real falloff(const Real& l, const HostForce& force) const {
        const Real left = r.note(site::left_of_force,
                                 Real(1.0F) - r.divide(site::left_of_force, l, r.uniform(site::reach, force.radius)));
        const Real base = r.decide(site::is_in_reach, left > 0.0F) ? left : Real(0.0F);
        const auto exponent = static_cast<int>(r.uniform(site::exponent, static_cast<int>(force.falloff)));
        return exponent == 0 ? Real(1.0F) : exponent == 1 ? base : base * base;
    }

    void vortex(Motion& m, const HostForce& force, const Vec3& p) const {
        const Vec3 n = r.uniform(site::axis, force.axis);
        const Vec3 way = r.note(site::to_centre, p - r.uniform(site::centre, force.centre));
        const Vec3 q = r.note(site::across, way - n * r.note(site::along_axis, r.dot(site::along_axis, n, way)));
        const Real l = r.note(site::distance, r.length(site::distance, q));
        if (!r.decide(site::is_off_axis, l > 0.0F))
            return;
        const Real f = falloff(l, force);
        const Vec3 swirl = cross_of(n, q) * r.divide(site::swirl, r.uniform(site::strength, force.strength) * f, l);
        m.acceleration = m.acceleration + r.note(site::swirl, swirl);
        const Vec3 sink = q * r.divide(site::sink, r.uniform(site::pull, force.pull) * f, l);
        m.acceleration = m.acceleration - r.note(site::sink, sink);
    }

    void attraction(Motion& m, const HostForce& force, const Vec3& p) const {
        const Vec3 way = r.note(site::to_centre, r.uniform(site::centre, force.centre) - p);
        const Real l = r.note(site::distance, r.length(site::distance, way));
        if (r.decide(site::is_killed, l < r.uniform(site::pull, force.pull)))
            m.killed = true;
        if (!r.decide(site::is_off_centre, l > 0.0F))
            return;
        const Real strength = r.uniform(site::strength, force.strength);
        Real share;
        if (force.square < 0.0F) {
            share = r.divide(site::attraction, strength * falloff(l, force), l);
        } else {
            const Real q =
                r.note(site::spread, r.dot(site::spread, way, way) + r.uniform(site::softening, force.square));
            share = r.divide(site::attraction, strength, q * r.sqrt(site::spread, q));
        }
        m.acceleration = m.acceleration + r.note(site::attraction, way * share);
    }

    Vec3 curl_noise(const HostForce& force, const Vec3& p) const {
        const Vec3 x = r.note(site::noise_place,
                              p * r.uniform(site::frequency, force.radius) + r.uniform(site::offset, force.centre));
        constexpr float most = 4194304.0F;
        if (!r.decide(site::is_in_noise, r.abs(x.x) < most) || !r.decide(site::is_in_noise, r.abs(x.y) < most) ||
            !r.decide(site::is_in_noise, r.abs(x.z) < most))
            return {};
        const Noise<R> noise(r, static_cast<std::uint32_t>(force.seed));
        const Vec3 curl =
            switches_.curl_derivative == CurlDerivative::analytic ? noise.analytic_curl(x) : noise.difference_curl(x);
        return r.note(site::curl, curl) * r.uniform(site::strength, force.strength);
    }

    R& r;
    const Switches& switches_;
};

} // namespace lockstep::lifecycle
