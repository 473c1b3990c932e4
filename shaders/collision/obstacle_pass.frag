#version 330 core
#extension GL_ARB_gpu_shader5 : require
// Writes the obstacle's world position at the texel's centre into the collision detection texture; with search = depth
// its window depth.
#include "arithmetic.glsl"
#include "clamp_to.glsl"
#include "collision_code.glsl"
#include "triangle_interpolation.glsl"

flat in vec4 g_Clip[3];
flat in vec3 g_Position[3];

uniform int u_ClientWidth;
uniform int u_ClientHeight;

precise out vec4 o_Texel;
precise gl_FragDepth;

void main() {
    TriangleFragment fragment =
        triangle_fragment(g_Clip, ivec2(gl_FragCoord.xy), ivec2(u_ClientWidth, u_ClientHeight));
    if (!fragment.covered)
        discard;
    gl_FragDepth = fragment.depth;
#if SEARCH == SEARCH_DEPTH
    o_Texel = vec4(fragment.depth, 0.0, 0.0, 1.0);
#else
    o_Texel = encode_position(interpolate(g_Position, fragment.shares));
#endif
}
