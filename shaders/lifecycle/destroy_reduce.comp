#version 430 core
// How many survive in each block of 1,024. Twin: reference/lifecycle/destroy_reduce_twin.hpp.

#include "lifecycle.glsl"
#include "particles.glsl"
#include "survival.glsl"
#include "group_scan.glsl"

layout(local_size_x = 256) in;
layout(std430) buffer ScanSums { uint scan_sums[]; };

uniform uint u_FirstBlock;

void main() {
    uint d = counters[u_Emitter].may_die;
    uint total;
    group_scan(uint(bitCount(flags_of(gl_GlobalInvocationID.x * 4u, d))), total);
    if (gl_LocalInvocationID.x == 0u && gl_WorkGroupID.x < blocks_of(d))
        scan_sums[u_FirstBlock + gl_WorkGroupID.x] = total;
}
