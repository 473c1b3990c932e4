#version 430 core
// Pulls what is in the cone to the mouth, where it dies. Twin: reference/dust/vacuum_up_twin.hpp.

#include "dust.glsl"
#include "cone.glsl"

uniform float deltaTime;

#if SUCTION == SUCTION_FORCE_KERNEL
uniform float mass;

void vacuum(uint i) {
    vec3 position = position_of(i);
    vec3 force;
    if (!suction_force(position, force))
        return;
    vec3 v = add(velocity_of(i), mul(divided(force, mass), deltaTime));
    set_velocity(i, v);
    if (kills(position, add(position, mul(v, deltaTime))))
        die(i);
}
#else
uniform float cleanerForce;

vec3 unit_of(vec3 way) {
#if UNIT == UNIT_ENGINE
    float len = ls_sqrt(squared(way));
    return len > 1e-5 ? divided(way, len) : vec3(0.0);
#else
    return ls_normalize(way);
#endif
}

// The versions that move positions, not velocities.
void vacuum(uint i) {
    vec3 position = position_of(i);
    vec3 way = sub(controllerPos, position);
    float d2 = squared(way);
    if (d2 < cleanerSqrDeathRange) {
        die(i);
        return;
    }
    if (!(d2 < cleanerSqrDist))
        return;
#if SUCTION == SUCTION_LERP
    dust[i].position = lerp(position, controllerPos, min(max(mul(deltaTime, cleanerForce), 0.0), 1.0));
#else
    vec3 n = unit_of(way);
    float pull = ls_divide(mul(deltaTime, cleanerSqrForce), d2);
#if SUCTION == SUCTION_STEP
    dust[i].position = add(position, mul(n, pull));
#else
    float k = ls_dot(controllerForward, neg(n));
    if (!(k > cleanerDotThreshold))
        return;
    position = add(position, mul(mul(n, pull), k));
    dust[i].position = position;
    if (ls_dot(sub(controllerPos, position), n) < 0.0)
        die(i);
#endif
#endif
}
#endif

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= dustCount || dust[i].isAlive != 1)
        return;
    vacuum(i);
}
