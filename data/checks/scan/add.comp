#version 430
// Each tile's sums go on from the totals of the tiles before it.
layout(local_size_x = 128) in;
layout(std430) buffer Sums { uint sums[]; };
layout(std430) readonly buffer Totals { uint totals[]; };

void main() {
    uint before = 0u;
    for (uint tile = 0u; tile < gl_WorkGroupID.x; ++tile)
        before += totals[tile];
    sums[gl_GlobalInvocationID.x] += before;
}
