#version 430 core
// What one invocation counts when the ranks are closed. Twin: reference/lifecycle/post_destroy_twin.hpp.

#include "lifecycle.glsl"
#include "emission_ring.glsl"

layout(local_size_x = 1) in;
layout(std430) buffer Arguments { ArgumentWords arguments[]; };

uniform uint u_Request;

#if RIBBON == 1 && DISTANCE_SUM == DISTANCE_SUM_FIXED && UV_ANCHOR == UV_ANCHOR_FIXED
layout(std430) readonly buffer Survivors { uint survivors[]; };
layout(std430) readonly buffer Distances { uint distances[]; };

// What dies at the tail takes its length with it: u stays where it was.
void move_origin(uint s) {
    uint n = counters[u_Emitter].alive;
    uint first = s > 0u ? survivors[u_Base] : counters[u_Emitter].may_die;
    if (n > 0u && first > 0u)
        counters[u_Emitter].distance_origin += distances[u_Base + min(first, n - 1u)];
}
#else
void move_origin(uint s) {}
#endif

void main() {
    uint s = survivor_count();
    uint died = counters[u_Emitter].may_die - s;
    uint alive = present() - died;
    move_origin(s);
    counters[u_Emitter].survivors = s;
    counters[u_Emitter].died = died;
    counters[u_Emitter].alive = alive;
#if MANAGEMENT == MANAGEMENT_INDEX_LISTS
    counters[u_Emitter].list = 1u - counters[u_Emitter].list;
#endif
#if EMIT_WHEN == EMIT_WHEN_BEFORE_DESTROY
    count_emission(u_Request);
#endif
    arguments[u_Emitter].simulate = uint[3](groups_of(alive), 1u, 1u);
    arguments[u_Emitter].ribbon = uint[3](groups_of(alive), 1u, 1u);
}
