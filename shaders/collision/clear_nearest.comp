#version 430 core
// Nobody is offered to any texel yet (nearest_particle.glsl).

layout(local_size_x = 256) in;

layout(std430, binding = 2) writeonly buffer Nearest { uvec2 nearest[]; };

uniform uint u_TexelCount;

void main() {
    for (uint i = gl_GlobalInvocationID.x; i < u_TexelCount; i += 256u * gl_NumWorkGroups.x)
        nearest[i] = uvec2(0xffffffffu);
}
