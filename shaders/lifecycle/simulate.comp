#version 430 core
// A tick of every particle's life. Twin: reference/lifecycle/simulate_twin.hpp.

#include "lifecycle.glsl"
#include "particles.glsl"
#include "simulation.glsl"
#include "lists.glsl"

layout(local_size_x = 256) in;

void main() {
    uint i = gl_GlobalInvocationID.x;
#if MANAGEMENT == MANAGEMENT_INDEX_LISTS
    if (i >= present())
        return;
#else
    if (i >= counters[u_Emitter].alive)
        return;
#endif
    uint slot = slot_at(i);
    load(slot);
    simulate(slot);
    store(slot);
}
