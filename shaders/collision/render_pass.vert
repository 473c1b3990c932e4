#version 330 core
#extension GL_ARB_gpu_shader5 : require
// The render pass, one vertex a particle: takes it to view space and hands on its state.
#include "arithmetic.glsl"

in vec3 a_Position;
in float a_Speed;
in float a_CollideTime;

uniform mat4 u_View;

precise out vec3 v_Centre; // view space
precise out float v_Speed;
precise out float v_CollideTime;

void main() {
    v_Centre = ls_transform(u_View, a_Position).xyz;
    v_Speed = a_Speed;
    v_CollideTime = a_CollideTime;
}
