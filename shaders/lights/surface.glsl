// What a pixel shows of the triangle that its fragment was handed. Twin: reference/lights/surface.hpp.
#include "rounding.glsl"
#define COVERAGE_BY_FRAGMENT
#include "clamp_to.glsl"
#include "triangle_interpolation.glsl"

flat in vec4 g_Clip[3];
flat in vec3 g_Position[3];
flat in vec3 g_Albedo;

uniform int u_ClientWidth;
uniform int u_ClientHeight;
uniform vec3 u_Eye;

struct Surface {
    bool covered;
    vec3 position;
    vec3 normal;
    vec3 albedo;
    float depth;
};

float dot_of(vec3 a, vec3 b) { return add(add(mul(a.x, b.x), mul(a.y, b.y)), mul(a.z, b.z)); }

// The triangle's, turned to the viewer.
vec3 flat_normal() {
    vec3 n = cross_of(sub(g_Position[1], g_Position[0]), sub(g_Position[2], g_Position[0]));
    n = mul(n, ls_divide(1.0, ls_sqrt(dot_of(n, n))));
    return dot_of(n, sub(u_Eye, g_Position[0])) < 0.0 ? neg(n) : n;
}

Surface surface_here() {
    TriangleFragment fragment =
        triangle_fragment(g_Clip, ivec2(gl_FragCoord.xy), ivec2(u_ClientWidth, u_ClientHeight));
    return Surface(fragment.covered, interpolate(g_Position, fragment.shares), flat_normal(), g_Albedo,
                   fragment.depth);
}
