// A tick of the life of the particle at hand. Twin: reference/lifecycle/simulation.hpp.

uniform float u_Tick, u_HalfTickSquared;

#include "forces.glsl"

void grow_older() {
#if TICKS
    float left = sub(remaining(), 1.0);
    set_remaining(left > 0.0 ? left : 0.0);
#else
    set_remaining(sub(remaining(), u_Tick));
#endif
}

void simulate(uint slot) {
    dither_slot = slot;
    vec3 p = position(), v = velocity();
    Motion m = forced(p, v, acceleration());
    vec3 faster = add(v, mul(m.acceleration, u_Tick));
#if DRAG != DRAG_EXPLICIT
    faster = mul(faster, m.drag);
#endif
#if INTEGRATION == INTEGRATION_SEMI_IMPLICIT
    vec3 next = add(p, mul(faster, u_Tick));
#elif INTEGRATION == INTEGRATION_EXPLICIT
    vec3 next = add(p, mul(v, u_Tick));
#else
    vec3 next = add(add(p, mul(v, u_Tick)), mul(m.acceleration, u_HalfTickSquared));
#endif
#if CURL_USE == CURL_USE_VELOCITY
#if INTEGRATION == INTEGRATION_SEMI_IMPLICIT
    next = add(p, mul(add(faster, m.drift), u_Tick));
#else
    next = add(next, mul(m.drift, u_Tick));
#endif
#endif
#ifdef GRAPH_VELOCITY
    faster = m.velocity;
#endif
#ifdef GRAPH_POSITION
    next = m.position;
#endif
    set_position(next);
    set_velocity(faster);
    if (m.killed) {
        set_remaining(0.0);
        atomicAdd(counters[u_Emitter].killed, 1u);
    } else {
        grow_older();
    }
}
