// What accelerates a particle at a place. Twin: reference/system/force_fields.hpp.
#ifndef FORCE_FIELDS_GLSL
#define FORCE_FIELDS_GLSL
#include "noise.glsl"

float powered(float base, float exponent) { return exponent == 0.0 ? 1.0 : exponent == 1.0 ? base : mul(base, base); }

float falloff(float l, float radius, float exponent) {
    float left = sub(1.0, ls_divide(l, radius));
    return powered(left > 0.0 ? left : 0.0, exponent);
}

// `a` with a vortex around an axis of length 1.
vec3 vortex(vec3 a, vec3 p, vec3 centre, vec3 axis, float strength, float radius, float exponent, float pull) {
    vec3 way = sub(p, centre);
    vec3 q = sub(way, mul(axis, ls_dot(axis, way)));
    float l = ls_length(q);
    if (!(l > 0.0))
        return a;
    float f = falloff(l, radius, exponent);
    a = add(a, mul(cross_of(axis, q), ls_divide(mul(strength, f), l)));
    return sub(a, mul(q, ls_divide(mul(pull, f), l)));
}

// `a` with a pull along `way`, l long. square: of the softening; below 0: linear.
vec3 attraction(vec3 a, vec3 way, float l, float strength, float radius, float exponent, float square) {
    if (!(l > 0.0))
        return a;
    if (square < 0.0)
        return add(a, mul(way, ls_divide(mul(strength, falloff(l, radius, exponent)), l)));
    float q = add(ls_dot(way, way), square);
    return add(a, mul(way, ls_divide(strength, mul(q, ls_sqrt(q)))));
}

vec3 curl_noise(vec3 x, float strength, uint seed) {
    return in_noise(x) ? mul(curl(x, seed), strength) : vec3(0.0);
}
#endif
