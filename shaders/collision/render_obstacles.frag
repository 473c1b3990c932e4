#version 330 core
#extension GL_ARB_gpu_shader5 : require
#include "arithmetic.glsl"
#include "clamp_to.glsl"
#include "shading.glsl"
#include "triangle_interpolation.glsl"

flat in vec4 g_Clip[3];
flat in vec3 g_Position[3]; // view space

uniform int u_ClientWidth;
uniform int u_ClientHeight;

precise out vec4 o_Color;
precise gl_FragDepth;

void main() {
    TriangleFragment fragment =
        triangle_fragment(g_Clip, ivec2(gl_FragCoord.xy), ivec2(u_ClientWidth, u_ClientHeight));
    if (!fragment.covered)
        discard;
    gl_FragDepth = fragment.depth;
    o_Color = quantised(obstacle_color(g_Position));
}
