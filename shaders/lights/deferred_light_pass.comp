#version 430 core
// Lights what the G-buffer has. Twin: DeferredTwin in reference/lights/lighting_twin.hpp.
#include "rounding.glsl"
#include "lighting.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D u_SurfacePositionBefore;
uniform sampler2D u_SurfaceNormalBefore;
uniform sampler2D u_SurfaceAlbedoBefore;
layout(rgba32f) writeonly uniform image2D u_LitAfter;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(u_LitAfter))))
        return;
    vec4 position = texelFetch(u_SurfacePositionBefore, pixel, 0);
    vec3 lit = u_Background;
    if (position.w != 0.0) {
        vec3 normal = ls_flush3(texelFetch(u_SurfaceNormalBefore, pixel, 0).xyz);
        vec3 code = floor(texelFetch(u_SurfaceAlbedoBefore, pixel, 0).xyz * 255.0 + 0.5);
        lit = radiance(ls_flush3(position.xyz), normal, code / 256.0);
    }
    imageStore(u_LitAfter, pixel, vec4(lit, 1.0));
}
