#version 430 core
// Counts what was emitted after the simulation. Twin: reference/lifecycle/post_emit_twin.hpp.

#include "lifecycle.glsl"
#include "emission_ring.glsl"

layout(local_size_x = 1) in;
layout(std430) buffer Arguments { ArgumentWords arguments[]; };

uniform uint u_Request;

void main() {
    count_emission(u_Request);
    uint alive = counters[u_Emitter].alive + counters[u_Emitter].emitted;
    counters[u_Emitter].alive = alive;
    arguments[u_Emitter].ribbon = uint[3](groups_of(alive), 1u, 1u);
}
