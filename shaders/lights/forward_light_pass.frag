#version 430 core
// Lights the nearest triangle of each pixel. Twin: DrawnTwin in reference/lights/lighting_twin.hpp.
#include "surface.glsl"
#include "lighting.glsl"

layout(location = 0) out vec4 o_Lit;
layout(location = 1) out float o_Depth;
precise gl_FragDepth;

void main() {
    Surface here = surface_here();
    if (!here.covered)
        discard;
    gl_FragDepth = here.depth;
    o_Depth = here.depth;
    o_Lit = vec4(radiance(here.position, here.normal, here.albedo), 1.0);
}
