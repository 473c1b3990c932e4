#version 430 core
layout(local_size_x = 8) in;
layout(std430, binding = 0) buffer Values { float values[]; };
shared float sums[8];
uniform float u_Base;

void main() {
    uint i = gl_GlobalInvocationID.x, k = gl_LocalInvocationID.x;
    float unset;
    values[i] += unset;
    sums[k + i / 16u] = pow(u_Base, values[i]);
    values[i + 1u] = sums[(k + 1u) % 8u];
    if (k > 2u)
        barrier();
}
