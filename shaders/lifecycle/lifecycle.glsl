// What every kernel of an emitter sees: its segment of the buffers, its counters, and arithmetic of which each operation
// is rounded by itself. Twin: reference/lifecycle/counters.hpp.
#include "arithmetic.glsl"

uniform uint u_Emitter;  // its number
uniform uint u_Base;     // its first slot
uniform uint u_Capacity; // particles it may have

struct CounterWords {
    uint alive, emitted, may_die, survivors, append, died, serial, dropped;
    uint dropped_total, young, ring_head, distance_origin, clamped, killed, spare_0, spare_1;
};
layout(std430) buffer Counters { CounterWords counters[]; };

struct ArgumentWords {
    uint destroy[3], move[3], simulate[3], ribbon[3];
    uint draw_sprite[4], draw_ribbon[4];
};

uint groups_of(uint n) { return (n + 255u) >> 8; }
uint blocks_of(uint n) { return (n + 1023u) >> 10; }
#if COMPACTION == COMPACTION_SCAN
#define DESTROY_GROUPS(n) blocks_of(n)
#else
#define DESTROY_GROUPS(n) groups_of(n)
#endif

// Particles at the start of the destroy pass.
uint present() {
#if EMIT_WHEN == EMIT_WHEN_BEFORE_DESTROY
    return counters[u_Emitter].alive + counters[u_Emitter].emitted;
#else
    return counters[u_Emitter].alive;
#endif
}

uint survivor_count() {
#if COMPACTION == COMPACTION_SCAN
    return counters[u_Emitter].survivors;
#else
    return counters[u_Emitter].append;
#endif
}

float mul(float a, float b) {
#if ARITHMETIC == ARITHMETIC_EXACT
    return ls_multiply(a, b);
#else
    // NVIDIA's compute stage fuses a `precise` product of one function into a sum of another, but no fma.
    precise float product = fma(a, b, -0.0);
    return product;
#endif
}
float add(float a, float b) { return ls_add(a, b); }
float sub(float a, float b) { return ls_add(a, -b); }
vec3 mul(vec3 v, float s) { return vec3(mul(v.x, s), mul(v.y, s), mul(v.z, s)); }
vec3 add(vec3 a, vec3 b) { return vec3(add(a.x, b.x), add(a.y, b.y), add(a.z, b.z)); }
vec3 sub(vec3 a, vec3 b) { return vec3(sub(a.x, b.x), sub(a.y, b.y), sub(a.z, b.z)); }
vec3 neg(vec3 v) { return vec3(ls_flush(-v.x), ls_flush(-v.y), ls_flush(-v.z)); }
vec3 cross_of(vec3 a, vec3 b) {
    return vec3(sub(mul(a.y, b.z), mul(a.z, b.y)), sub(mul(a.z, b.x), mul(a.x, b.z)), sub(mul(a.x, b.y), mul(a.y, b.x)));
}
