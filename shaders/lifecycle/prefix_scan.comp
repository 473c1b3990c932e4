#version 430 core
// The sums of the blocks up to each block: one group, 256 blocks at a time. Twin: reference/lifecycle/ribbon_twin.hpp.

#include "lifecycle.glsl"
#include "lengths.glsl"
#include "length_scan.glsl"

layout(local_size_x = 256) in;
layout(std430) buffer LengthSums { Length length_sums[]; };

uniform uint u_FirstBlock;

void main() {
    uint blocks = groups_of(counters[u_Emitter].alive);
    Length carry = NO_LENGTH;
    for (uint start = 0u; start < blocks; start += 256u) {
        uint block = start + gl_LocalInvocationID.x;
        Length sum = plus(carry, length_scan(block < blocks ? length_sums[u_FirstBlock + block] : NO_LENGTH));
        if (block < blocks)
            length_sums[u_FirstBlock + block] = sum;
        carry = plus(carry, partial[255]);
        barrier();
    }
}
