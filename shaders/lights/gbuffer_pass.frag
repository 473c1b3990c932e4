#version 430 core
// Stores what the nearest triangle of each pixel is. Twin: DrawnTwin in reference/lights/lighting_twin.hpp.
#include "surface.glsl"
#include "half.glsl"

layout(location = 0) out vec4 o_Position; // alpha 1: there is a surface
layout(location = 1) out vec4 o_Normal;
layout(location = 2) out vec4 o_Albedo; // its codes / 255
layout(location = 3) out float o_Depth;
precise gl_FragDepth;

vec4 stored(vec3 v) {
#if GBUFFER_FORMAT == GBUFFER_FORMAT_RGBA16F
    return half_round(vec4(v, 1.0));
#else
    return vec4(v, 1.0);
#endif
}

void main() {
    Surface here = surface_here();
    if (!here.covered)
        discard;
    gl_FragDepth = here.depth;
    o_Position = stored(here.position);
    o_Normal = stored(here.normal);
    o_Albedo = vec4(here.albedo * 256.0 / 255.0, 1.0);
    o_Depth = here.depth;
}
