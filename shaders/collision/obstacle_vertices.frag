#version 330 core
#extension GL_ARB_gpu_shader5 : require
#include "collision_code.glsl"

flat in vec3 g_Position;

precise out vec4 o_Texel;

void main() { o_Texel = encode_position(g_Position); }
