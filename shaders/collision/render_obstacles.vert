#version 330 core
#extension GL_ARB_gpu_shader5 : require
// Takes an obstacle's corner to view space and on to the render camera's image.
#include "arithmetic.glsl"

in vec3 a_Position;

uniform mat4 u_View;
uniform mat4 u_Projection;

precise out vec3 v_Position; // view space
precise gl_Position;

void main() {
    v_Position = ls_transform(u_View, a_Position).xyz;
    gl_Position = ls_transform(u_Projection, v_Position);
}
