#version 430
// Running sums of tiles of 128 values, each by itself.
layout(local_size_x = 128) in;
layout(std430) readonly buffer Values { uint values[]; };
layout(std430) buffer Sums { uint sums[]; };
layout(std430) buffer Totals { uint totals[]; };

void main() {
    uint sum = 0u;
    for (uint k = gl_WorkGroupID.x * 128u; k <= gl_GlobalInvocationID.x; ++k)
        sum += values[k];
    sums[gl_GlobalInvocationID.x] = sum;
    if (gl_LocalInvocationID.x == 127u)
        totals[gl_WorkGroupID.x] = sum;
}
