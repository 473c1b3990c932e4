#version 430 core
// The sums of the blocks before each block, and of all: one group, 1,024 blocks at a time. Twin:
// reference/lifecycle/destroy_scan_twin.hpp.

#include "lifecycle.glsl"
#include "group_scan.glsl"

layout(local_size_x = 256) in;
layout(std430) buffer ScanSums { uint scan_sums[]; };

uniform uint u_FirstBlock;

void main() {
    uint blocks = blocks_of(counters[u_Emitter].may_die);
    uint carry = 0u;
    for (uint start = 0u; start < blocks; start += 1024u) {
        uint first = start + gl_LocalInvocationID.x * 4u;
        uint sum[4];
        uint own = 0u;
        for (uint k = 0u; k < 4u; ++k) {
            sum[k] = first + k < blocks ? scan_sums[u_FirstBlock + first + k] : 0u;
            own += sum[k];
        }
        uint total;
        uint below = carry + group_scan(own, total);
        for (uint k = 0u; k < 4u; ++k) {
            if (first + k < blocks)
                scan_sums[u_FirstBlock + first + k] = below;
            below += sum[k];
        }
        carry += total;
    }
    if (gl_LocalInvocationID.x == 0u)
        counters[u_Emitter].survivors = carry;
}
