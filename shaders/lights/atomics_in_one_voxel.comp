#version 430 core
// All lights add to one voxel.
#include "atomics.glsl"

void main() {
    uint light = gl_GlobalInvocationID.x;
    if (light >= u_LightCount)
        return;
    for (uint k = 0u; k < u_VoxelsEach; ++k)
        add_to_each_word(u_GridSize / 2, light | 1u);
}
