// What every kernel of an emitter sees: its segment of the buffers and its counters. Twin:
// reference/lifecycle/counters.hpp.
#include "rounding.glsl"

uniform uint u_Emitter;  // its number
uniform uint u_Base;     // its first slot
uniform uint u_Capacity; // particles it may have

struct CounterWords {
    uint alive, emitted, may_die, survivors, append, died, serial, dropped;
    uint dropped_total, young, ring_head, distance_origin, clamped, killed, buried, list;
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
