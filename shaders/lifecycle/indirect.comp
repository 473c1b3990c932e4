#version 430 core
// What is drawn, and who may die in the next frame. Twin: reference/lifecycle/indirect_twin.hpp.

#include "lifecycle.glsl"

layout(local_size_x = 1) in;
layout(std430) buffer Arguments { ArgumentWords arguments[]; };
#if DIES == DIES_WINDOW && EMIT_WHEN == EMIT_WHEN_BEFORE_DESTROY
layout(std430) readonly buffer Ring { uint ring[]; };
uniform uint u_FirstInRing;
#endif

uniform uint u_Corners; // of what a sprite is drawn as

void main() {
    uint alive = counters[u_Emitter].alive;
    uint segments = max(alive, 1u) - 1u;
    counters[u_Emitter].append = 0u;
#if MANAGEMENT == MANAGEMENT_INDEX_LISTS
    counters[u_Emitter].buried = 0u;
#endif
#if ARITHMETIC == ARITHMETIC_EXACT
    arguments[u_Emitter].draw_sprite = uint[4](alive, 1u, 0u, 0u);
    arguments[u_Emitter].draw_ribbon = uint[4](segments, 1u, 0u, 0u);
#else
    arguments[u_Emitter].draw_sprite = uint[4](u_Corners, alive, 0u, 0u);
    arguments[u_Emitter].draw_ribbon = uint[4](4u, segments, 0u, 0u);
#endif
#if DIES == DIES_NONE
    uint d = 0u;
#elif DIES == DIES_ALL
    uint d = alive;
#elif EMIT_WHEN == EMIT_WHEN_BEFORE_DESTROY
    uint d = alive + ring[u_FirstInRing + counters[u_Emitter].ring_head] - counters[u_Emitter].young;
#else
    uint d = alive - counters[u_Emitter].young;
#endif
    counters[u_Emitter].may_die = d;
    arguments[u_Emitter].destroy = uint[3](DESTROY_GROUPS(d), 1u, 1u);
#if EMIT_WHEN == EMIT_WHEN_AFTER_SIMULATION
    arguments[u_Emitter].move = uint[3](groups_of(alive), 1u, 1u);
#endif
}
