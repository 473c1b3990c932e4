#version 430 core
// What a disc adds to a pixel, where nothing nearer is.
#include "rounding.glsl"

flat in vec3 v_Colour;
flat in vec2 v_Centre;
flat in float v_Radius;
flat in float v_Depth;

uniform float u_GlowGain;
uniform sampler2D u_SurfaceDepthBefore;

layout(location = 0) out vec4 o_Light;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    if (!(v_Depth >= 0.0 && v_Depth <= 1.0 && v_Depth < texelFetch(u_SurfaceDepthBefore, pixel, 0).x))
        discard;
    float dx = ls_divide(sub(add(float(pixel.x), 0.5), v_Centre.x), v_Radius);
    float dy = ls_divide(sub(add(float(pixel.y), 0.5), v_Centre.y), v_Radius);
    float d2 = add(mul(dx, dx), mul(dy, dy));
    if (!(d2 < 1.0))
        discard;
    o_Light = vec4(mul(mul(v_Colour, sub(1.0, d2)), u_GlowGain), 0.0);
}
