#version 330 core
#extension GL_ARB_gpu_shader5 : require
// Stores the particle; the depth test keeps the one nearest to the camera, of equally deep ones the first drawn.
#include "collision_code.glsl"

flat in vec3 v_Position;
flat in vec4 v_Velocity;
flat in ivec2 v_Key;

layout(location = 0) out vec4 o_Texel;
layout(location = 1) out ivec2 o_Key;
#if RESPONSE == RESPONSE_MUTUAL
layout(location = 2) out vec4 o_Velocity;
#endif

void main() {
    o_Texel = encode_position(v_Position);
    o_Key = v_Key;
#if RESPONSE == RESPONSE_MUTUAL
    o_Velocity = vec4(encode_position(v_Velocity.xyz).xyz, v_Velocity.w);
#endif
}
