#version 430 core
// Floats are added to a few words by compare-and-swap.
layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Given { float given[]; };
layout(std430, binding = 1) coherent buffer Sums { uint sums[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    uint at = i % uint(sums.length());
    uint expected = sums[at];
    for (;;) {
        precise float sum = uintBitsToFloat(expected) + given[i];
        uint found = atomicCompSwap(sums[at], expected, floatBitsToUint(sum));
        if (found == expected)
            break;
        expected = found;
    }
}
