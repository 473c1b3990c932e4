#version 330 core
#extension GL_ARB_gpu_shader5 : require
#include "arithmetic.glsl"
#include "clamp_to.glsl"
#include "shading.glsl"

uniform int u_ClientHeight;

precise out vec4 o_Color;

void main() { o_Color = quantised(background_color(int(gl_FragCoord.y), u_ClientHeight)); }
