#version 430 core
// A step of the filter that smooths the depths. Twin: reference/fluid/depth_filter_twin.hpp.
#include "rounding.glsl"
#include "clamp_to.glsl"
#include "powers.glsl"
#include "depth.glsl"
#include "source.glsl"
#include "working.glsl"
#if FILTER == FILTER_NARROW_RANGE
#include "narrow_range.glsl"
#elif FILTER == FILTER_CURVATURE_FLOW
#include "curvature_flow.glsl"
#else
#include "weighted_mean.glsl"
#endif

layout(local_size_x = 8, local_size_y = 8) in;

layout(r32f) writeonly uniform image2D u_SmoothDepthAfter;

float smoothed(ivec2 pixel) {
    float stored = stored_at(pixel, ivec2(0));
    if (is_nothing(stored))
        return stored;
    if (is_lost(stored))
        return 0.0;
    return stored_of_working(filtered(pixel, working_of(stored)));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (is_inside(pixel))
        imageStore(u_SmoothDepthAfter, pixel, vec4(smoothed(pixel)));
}
