#version 430 core
// A chequered surface. Twin: reference/fluid/scene_twin.hpp.
#include "rounding.glsl"
#define COVERAGE_BY_FRAGMENT
#include "clamp_to.glsl"
#include "triangle_interpolation.glsl"

flat in vec4 g_Clip[3];
flat in vec3 g_Position[3];

uniform int u_ClientWidth;
uniform int u_ClientHeight;

layout(location = 0) out vec4 o_Scene;
layout(location = 1) out float o_SceneDepth;
precise gl_FragDepth;

// Which of two colours a cube of 1 m has.
float grey(vec3 position) {
    vec3 cube = floor(position);
    float sum = add(add(cube.x, cube.y), cube.z);
    float t = mul(0.5, sub(sum, mul(2.0, floor(mul(sum, 0.5)))));
    return add(mul(0.8, sub(1.0, t)), mul(0.9, t));
}

void main() {
    TriangleFragment here = triangle_fragment(g_Clip, ivec2(gl_FragCoord.xy), ivec2(u_ClientWidth, u_ClientHeight));
    if (!here.covered)
        discard;
    gl_FragDepth = here.depth;
    o_SceneDepth = here.depth;
    o_Scene = vec4(vec3(grey(interpolate(g_Position, here.shares))), 1.0);
}
