#version 430 core
// Each light adds to voxels here and there.
#include "atomics.glsl"
#include "rounding.glsl"
#include "random.glsl"

void main() {
    uint light = gl_GlobalInvocationID.x;
    if (light >= u_LightCount)
        return;
    for (uint k = 0u; k < u_VoxelsEach; ++k)
        add_to_each_word(ivec3(pcg3d(uvec3(light, k, 0u)) & uvec3(u_GridSize - 1)), light | 1u);
}
