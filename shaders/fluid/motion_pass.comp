#version 430 core
// The particles where the host has moved them. Twin: reference/fluid/motion_twin.hpp.
#include "arithmetic.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer positionBuffer { vec4 moved[]; };
layout(std430) writeonly buffer ParticlesAfter { vec4 positions[]; };

uniform uint u_ParticleCount;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < u_ParticleCount)
        positions[i] = vec4(ls_flush3(moved[i].xyz), ls_flush(moved[i].w));
}
