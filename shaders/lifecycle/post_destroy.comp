#version 430 core
// What one invocation counts when the ranks are closed. Twin: reference/lifecycle/post_destroy_twin.hpp.

#include "lifecycle.glsl"
#include "emission_ring.glsl"

layout(local_size_x = 1) in;
layout(std430) buffer Arguments { ArgumentWords arguments[]; };

uniform uint u_Request;

void main() {
    uint s = survivor_count();
    uint died = counters[u_Emitter].may_die - s;
    uint alive = present() - died;
    counters[u_Emitter].survivors = s;
    counters[u_Emitter].died = died;
    counters[u_Emitter].alive = alive;
#if EMIT_WHEN == EMIT_WHEN_BEFORE_DESTROY
    count_emission(u_Request);
#endif
    arguments[u_Emitter].simulate = uint[3](groups_of(alive), 1u, 1u);
    arguments[u_Emitter].ribbon = uint[3](groups_of(alive), 1u, 1u);
}
