#pragma once
#include "reference/lifecycle/forces.hpp"
#include "reference/lifecycle/graphs.hpp"

namespace lockstep::lifecycle {

/// What the passes of one frame ask of an emitter, made once.
struct FrameOf {
    HostPtr host;
    const HostEmitter* of = nullptr;
    int frame = 0;
    std::vector<HostForce> forces = {};
    StageGraph graph = {}; ///< of the simulation
};

inline FrameOf frame_of(const HostPtr& host, const HostEmitter& of, int frame, const StageGraph& graph) {
    return {host, &of, frame, of.forces(frame), graph};
}
inline FrameOf frame_of(const HostPtr& host, const HostEmitter& of, int frame) {
    return frame_of(host, of, frame, stage_graph(of.settings().simulation));
}
/// Of another frame.
inline FrameOf frame_of(const FrameOf& known, int frame) { return frame_of(known.host, *known.of, frame, known.graph); }

/// What the graph makes of a step, without the emitter's forces.
template <class R> typename Forces<R>::Motion motion_of_graph(R& r, const FrameOf& frame, const Particle<R>& particle,
                                                              const typename R::Vec3& v) {
    using Real = typename R::Real;
    const Host& host = *frame.host;
    const StageRun<R> run(r, host, *frame.of, frame.graph, [&](std::string_view name) {
        return value_of(r, host, particle, host.time(frame.frame), name);
    });
    typename Forces<R>::Motion m{run.vec3("acceleration").value_or(particle.acceleration()), {}};
    if (const auto k = run.real("drag")) {
        if (host.switches().drag == Drag::explicit_force) {
            m.acceleration = m.acceleration - r.note(site::drag, v * *k);
        } else {
            const Real slower = Real(1.0F) + *k * r.uniform(site::tick, host.settings().tick);
            m.drag = m.drag * r.divide(site::drag_factor, Real(1.0F), slower);
        }
    }
    if (const auto killed = run.number("kill"))
        m.killed = killed->whole != 0;
    m.velocity = run.vec3("velocity");
    m.position = run.vec3("position");
    return m;
}

/// A tick of a particle's life. Twin of shaders/lifecycle/simulation.glsl. Returns whether it is killed.
template <class R> bool simulate(R& r, const FrameOf& frame, Particle<R>& particle) {
    using Vec3 = typename R::Vec3;
    using Real = typename R::Real;
    const Switches& switches = frame.host->switches();
    const Real tick = r.uniform(site::tick, frame.host->settings().tick);
    const Vec3 p = particle.position(), v = particle.velocity();
    const auto own =
        frame.graph ? motion_of_graph(r, frame, particle, v) : typename Forces<R>::Motion{particle.acceleration(), {}};
    const auto m = Forces<R>(r, switches).motion(frame.forces, p, v, own);
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
    if (m.velocity)
        faster = *m.velocity;
    if (m.position)
        next = *m.position;
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
