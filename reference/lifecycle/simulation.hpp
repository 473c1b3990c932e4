#pragma once
#include "reference/lifecycle/forces.hpp"
#include "reference/lifecycle/particle.hpp"

namespace lockstep::lifecycle {

/// What the passes of one frame ask of an emitter, made once.
struct FrameOf {
    HostPtr host;
    const HostEmitter* of = nullptr;
    int frame = 0;
    std::vector<HostForce> forces = {};
};

inline FrameOf frame_of(const HostPtr& host, const HostEmitter& of, int frame) {
    return {host, &of, frame, of.forces(frame)};
}

/// A tick of a particle's life. Twin of shaders/lifecycle/simulation.glsl. Returns whether it is killed.
template <class R> bool simulate(R& r, const FrameOf& frame, Particle<R>& particle) {
    using Vec3 = typename R::Vec3;
    using Real = typename R::Real;
    const Switches& switches = frame.host->switches();
    const Real tick = r.uniform(site::tick, frame.host->settings().tick);
    const Vec3 p = particle.position(), v = particle.velocity();
    const auto m = Forces<R>(r, switches).motion(frame.forces, p, v, particle.acceleration());
    const Vec3 a = r.note(site::force, m.acceleration);
    Vec3 faster = r.note(site::faster, v + a * tick);
    if (switches.drag != Drag::explicit_force)
        faster = r.note(site::braked, faster * m.drag);
    const bool drifts = switches.curl_use == CurlUse::velocity;
    Vec3 next;
    switch (switches.integration) {
    case Integration::semi_implicit: {
        const Vec3 mover = r.note(site::moving_velocity, drifts ? faster + m.drift : faster);
        next = p + r.note(site::way, mover * tick);
        break;
    }
    case Integration::explicit_euler:
        next = p + r.note(site::way, v * tick);
        break;
    case Integration::ballistic:
        next =
            (p + r.note(site::way, v * tick)) + a * r.uniform(site::half_tick_squared, frame.host->half_tick_squared());
        break;
    }
    if (drifts && switches.integration != Integration::semi_implicit)
        next = next + m.drift * tick;
    particle.set_position(r.note(site::position, next));
    particle.set_velocity(r.note(site::velocity, faster));
    if (m.killed) {
        particle.set_remaining(r.note(site::remaining, Real(0.0F)));
        return true;
    }
    const Real before = particle.remaining();
    if (!particle.counts_ticks()) {
        particle.set_remaining(r.note(site::remaining, before - r.note(site::aged, tick)));
        return false;
    }
    Real left = r.note(site::remaining, before - r.note(site::aged, Real(1.0F)));
    if (!r.decide(site::not_below_zero, left > 0.0F))
        left = Real(0.0F);
    particle.set_remaining(left);
    return false;
}

} // namespace lockstep::lifecycle
