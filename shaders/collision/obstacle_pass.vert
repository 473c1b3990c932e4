#version 330 core
#extension GL_ARB_gpu_shader5 : require
// Projects an obstacle's corner into the collision camera.
#include "arithmetic.glsl"

in vec3 a_Position;

uniform mat4 u_ProjView;

precise out vec3 v_Position;
precise gl_Position;

void main() {
    v_Position = ls_flush3(a_Position);
    gl_Position = ls_transform(u_ProjView, a_Position);
}
