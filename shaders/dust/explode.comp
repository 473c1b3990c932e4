#version 430 core
// A ball of the cannon blows grains away from where it hit. Twin: reference/dust/explode_twin.hpp.

#include "dust.glsl"

uniform vec3 explosionPosition;
uniform float explosionSqrRange, explosionForce;
uniform float mass, impulseDeltaTime;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= dustCount || dust[i].isAlive != 1)
        return;
    vec3 way = sub(position_of(i), explosionPosition);
    float d2 = squared(way);
    if (!(d2 < explosionSqrRange))
        return;
    float f = mul(sub(1.0, ls_divide(d2, explosionSqrRange)), explosionForce);
    vec3 blast = mul(direction_of(way), f);
    set_velocity(i, add(velocity_of(i), mul(divided(blast, mass), impulseDeltaTime)));
}
