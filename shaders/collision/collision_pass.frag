#version 330 core
#extension GL_ARB_gpu_shader5 : require
// Writes the particle's new world position into the collision detection texture of the next frame; the depth test
// keeps the particle nearest to the collision camera.
#include "collision_code.glsl"

flat in vec3 out_Position;
precise out vec4 o_Texel;

void main() { o_Texel = encode_position(out_Position); }
