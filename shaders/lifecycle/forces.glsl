// What accelerates a particle. Twin: reference/lifecycle/forces.hpp.
#include "noise.glsl"

#define FORCE_DRAG 0
#define FORCE_VORTEX 1
#define FORCE_ATTRACTION 2
#define FORCE_CURL_NOISE 3

// One in the list of the emitter. Sixteen words; what a force has no use for is 0.
struct ForceWords {
    float kind;
    float centre[3]; // of curl noise the offset in this frame
    float axis[3];
    float strength;
    float radius; // of curl noise the frequency
    float falloff;
    float pull;   // of attraction the kill radius
    float square; // of attraction the softening squared; below 0: linear
    float drag;   // k, or the factor of a frame
    float seed;
    float spare[2];
};
layout(std430) readonly buffer Forces { ForceWords forces[]; };

uniform int u_ForceCount;

float powered(float base, float exponent) { return exponent == 0.0 ? 1.0 : exponent == 1.0 ? base : mul(base, base); }

float falloff(float l, float radius, float exponent) {
    float left = sub(1.0, ls_divide(l, radius));
    return powered(left > 0.0 ? left : 0.0, exponent);
}

vec3 of_words(float v[3]) { return ls_flush3(vec3(v[0], v[1], v[2])); }

vec3 vortex(ForceWords force, vec3 a, vec3 p) {
    vec3 n = of_words(force.axis);
    vec3 r = sub(p, of_words(force.centre));
    vec3 q = sub(r, mul(n, ls_dot(n, r)));
    float l = ls_length(q);
    if (!(l > 0.0))
        return a;
    float f = falloff(l, force.radius, force.falloff);
    a = add(a, mul(cross_of(n, q), ls_divide(mul(force.strength, f), l)));
    return sub(a, mul(q, ls_divide(mul(force.pull, f), l)));
}

vec3 attraction(ForceWords force, vec3 a, vec3 p, inout bool killed) {
    vec3 r = sub(of_words(force.centre), p);
    float l = ls_length(r);
    if (l < force.pull)
        killed = true;
    if (!(l > 0.0))
        return a;
    if (force.square < 0.0)
        return add(a, mul(r, ls_divide(mul(force.strength, falloff(l, force.radius, force.falloff)), l)));
    float q = add(ls_dot(r, r), force.square);
    return add(a, mul(r, ls_divide(force.strength, mul(q, ls_sqrt(q)))));
}

vec3 curl_noise(ForceWords force, vec3 p) {
    vec3 x = add(mul(p, force.radius), of_words(force.centre));
    return in_noise(x) ? mul(curl(x, uint(force.seed)), force.strength) : vec3(0.0);
}

struct Motion {
    vec3 acceleration;
    vec3 drift; // a velocity that moves the particle and is not kept
    float drag; // what is left of the velocity
    bool killed;
};

Motion forced(vec3 p, vec3 v, vec3 a) {
    Motion m = Motion(a, vec3(0.0), 1.0, false);
    for (int k = 0; k < u_ForceCount; ++k) {
        ForceWords force = forces[k];
        int kind = int(force.kind);
        if (kind == FORCE_DRAG) {
#if DRAG == DRAG_EXPLICIT
            m.acceleration = sub(m.acceleration, mul(v, force.drag));
#else
            m.drag = mul(m.drag, force.drag);
#endif
        } else if (kind == FORCE_VORTEX) {
            m.acceleration = vortex(force, m.acceleration, p);
        } else if (kind == FORCE_ATTRACTION) {
            m.acceleration = attraction(force, m.acceleration, p, m.killed);
        } else {
#if CURL_USE == CURL_USE_FORCE
            m.acceleration = add(m.acceleration, curl_noise(force, p));
#else
            m.drift = add(m.drift, curl_noise(force, p));
#endif
        }
    }
    return m;
}
