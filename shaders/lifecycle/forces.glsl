// What accelerates a particle. Twin: reference/lifecycle/forces.hpp.
#include "force_fields.glsl"

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

vec3 of_words(float v[3]) { return ls_flush3(vec3(v[0], v[1], v[2])); }

vec3 with_vortex(ForceWords force, vec3 a, vec3 p) {
    return vortex(a, p, of_words(force.centre), of_words(force.axis), force.strength, force.radius, force.falloff,
                  force.pull);
}

vec3 with_attraction(ForceWords force, vec3 a, vec3 p, inout bool killed) {
    vec3 way = sub(of_words(force.centre), p);
    float l = ls_length(way);
    if (l < force.pull)
        killed = true;
    return attraction(a, way, l, force.strength, force.radius, force.falloff, force.square);
}

vec3 noise_at(ForceWords force, vec3 p) {
    vec3 x = add(mul(p, force.radius), of_words(force.centre));
    return curl_noise(x, force.strength, uint(force.seed));
}

struct Motion {
    vec3 acceleration;
    vec3 drift; // a velocity that moves the particle and is not kept
    float drag; // what is left of the velocity
    bool killed;
    vec3 position, velocity; // of a graph that gives them
};
#include "simulation_graph.glsl"

Motion forced(vec3 p, vec3 v, vec3 a) {
    Motion m = Motion(a, vec3(0.0), 1.0, false, vec3(0.0), vec3(0.0));
    graph_motion(m, p, v);
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
            m.acceleration = with_vortex(force, m.acceleration, p);
        } else if (kind == FORCE_ATTRACTION) {
            m.acceleration = with_attraction(force, m.acceleration, p, m.killed);
        } else {
#if CURL_USE == CURL_USE_FORCE
            m.acceleration = add(m.acceleration, noise_at(force, p));
#else
            m.drift = add(m.drift, noise_at(force, p));
#endif
        }
    }
    return m;
}
