#version 430 core
// Numbers to codes of 8 bits. Twin: reference/system/encode_twin.hpp.
#include "rounding.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

#if ENCODING == ENCODING_SRGB_TABLE
layout(std430) readonly buffer thresholdBuffer { float thresholds[]; };
#endif

uniform sampler2D u_LitBefore;
layout(rgba8) writeonly uniform image2D u_EncodedAfter;

float code(float x) {
    x = x > 0.0 ? (x < 1.0 ? x : 1.0) : 0.0;
#if ENCODING == ENCODING_SRGB_TABLE
    int k = 0;
    for (int by = 128; by > 0; by /= 2)
        if (thresholds[k + by - 1] <= x)
            k += by;
    return float(k);
#else
    return floor(add(mul(255.0, x), 0.5));
#endif
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(u_EncodedAfter))))
        return;
    vec3 lit = ls_flush3(texelFetch(u_LitBefore, pixel, 0).xyz);
    imageStore(u_EncodedAfter, pixel, vec4(vec3(code(lit.x), code(lit.y), code(lit.z)) / 255.0, 1.0));
}
