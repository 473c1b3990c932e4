#version 430 core
// Closes the ranks: the survivors of those that may die, then all others. Twin: reference/lifecycle/move_twin.hpp.

#include "lifecycle.glsl"
#include "particles.glsl"
#if FUSE == FUSE_FUSED
#include "simulation.glsl"
#endif

layout(local_size_x = 256) in;
layout(std430) readonly buffer Survivors { uint survivors[]; };

void main() {
    uint j = gl_GlobalInvocationID.x;
    uint s = survivor_count(), d = counters[u_Emitter].may_die;
    if (j >= s + present() - d)
        return;
    load(j < s ? survivors[u_Base + j] : d + (j - s));
#if FUSE == FUSE_FUSED
    simulate(j);
#endif
    store(j);
}
