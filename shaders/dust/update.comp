#version 430 core
// A frame of flight: gravity, drag, colliders. Twin: reference/dust/update_twin.hpp.

#include "dust.glsl"
#include "cone.glsl"
#include "colliders.glsl"

uniform float deltaTime, airResistance, mass;
uniform vec3 gravity;
uniform int isRunning; // the vacuum that works in this kernel, or worked before it

vec3 accelerated(vec3 v, vec3 a) {
#if DRAG_STEP == DRAG_STEP_IMPLICIT
    return divided(add(v, mul(a, deltaTime)), add(1.0, mul(airResistance, deltaTime)));
#else
    vec3 drag = mul(v, airResistance);
#if DRAG == DRAG_BY_MASS
    drag = divided(drag, mass);
#endif
    return add(v, mul(sub(a, drag), deltaTime));
#endif
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= dustCount || dust[i].isAlive != 1)
        return;
    Movement m;
    m.current = position_of(i);
    vec3 a = vec3(0.0);
    bool sucked = false;
#if SUCTION == SUCTION_FORCE_IN_UPDATE
    vec3 force;
    if (isRunning == 1 && suction_force(m.current, force)) {
        a = divided(force, mass);
        sucked = true;
    }
#endif
    a = add(a, gravity);
    m.velocity = accelerated(velocity_of(i), a);
    m.next = add(m.current, mul(m.velocity, deltaTime));
#if WORLD_ORDER == WORLD_ORDER_FIRST
    world(m);
#endif
    list_of_colliders(m);
#if WORLD_ORDER == WORLD_ORDER_LAST
    world(m);
#endif
    set_velocity(i, m.velocity);
    dust[i].position = m.next;
#if SUCTION == SUCTION_FORCE_IN_UPDATE
    if (sucked && kills(m.current, m.next))
        die(i);
#elif SUCTION == SUCTION_FORCE_KERNEL && FORECAST == FORECAST_MOVED
    // Nothing moved the grain since the vacuum's kernel: it pulled who is in the cone.
    vec3 force;
    if (isRunning == 1 && suction_force(m.current, force) && kills(m.current, m.next))
        die(i);
#endif
}
