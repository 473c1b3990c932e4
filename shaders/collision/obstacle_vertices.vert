#version 330 core
#extension GL_ARB_gpu_shader5 : require
// Projects an obstacle's vertex into the collision camera, to be drawn as a point like a particle.
#include "arithmetic.glsl"
#include "base_texel.glsl"

in vec3 a_Position;

uniform mat4 u_ProjView;

precise out vec3 v_Position;
precise gl_Position;

void main() {
    v_Position = ls_flush3(a_Position);
    gl_Position = point_position(ls_transform(u_ProjView, a_Position));
}
