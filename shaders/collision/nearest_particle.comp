#version 430 core
// Of the particles whose depth is the least in their texel, the lowest index: what nearest_particle.glsl leaves open
// where there are no 64-bit atomics. One invocation a particle.

layout(local_size_x = 64) in;

layout(std430, binding = 2) buffer Nearest { uint nearest[]; };         // two a texel: particle, depth
layout(std430, binding = 3) readonly buffer Offers { uvec2 offers[]; }; // one a particle: texel, depth

uniform uint u_ParticleCount;

const uint nowhere = 0xffffffffu;

void main() {
    uint self = gl_GlobalInvocationID.x;
    if (self >= u_ParticleCount)
        return;
    uvec2 offer = offers[self];
    if (offer.x != nowhere && nearest[2u * offer.x + 1u] == offer.y)
        atomicMin(nearest[2u * offer.x], self);
}
