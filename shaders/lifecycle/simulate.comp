#version 430 core
// A tick of every particle's life. Twin: reference/lifecycle/simulate_twin.hpp.

#include "lifecycle.glsl"
#include "particles.glsl"
#include "simulation.glsl"

layout(local_size_x = 256) in;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= counters[u_Emitter].alive)
        return;
    load(i);
    simulate(i);
    store(i);
}
