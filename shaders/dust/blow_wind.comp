#version 430 core
// A cone of wind. Twin: reference/dust/blow_wind_twin.hpp.

#include "dust.glsl"

uniform vec3 controllerPos, controllerForward;
uniform float blowerSqrForce, blowerSqrDist, blowerDotThreshold;
uniform float mass, impulseDeltaTime;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= dustCount || dust[i].isAlive != 1)
        return;
    vec3 way = sub(position_of(i), controllerPos);
    float d2 = squared(way);
    if (!(d2 < blowerSqrDist))
        return;
#if SAFE_DIRECTION == SAFE_DIRECTION_ON || ARITHMETIC == ARITHMETIC_EXACT
    if (!(d2 > 0.0)) // as in cone.glsl
        return;
#endif
    vec3 n = ls_normalize(way);
    float k = ls_dot(controllerForward, n);
    if (!(k > blowerDotThreshold))
        return;
#if BLOW_FALLOFF == BLOW_FALLOFF_SQUARE
    float d = d2;
#else
    float d = ls_sqrt(d2);
#endif
    vec3 force = mul(mul(n, ls_divide(blowerSqrForce, d)), k);
    set_velocity(i, add(velocity_of(i), mul(divided(force, mass), impulseDeltaTime)));
}
