#version 430 core
// The surface's normal at each pixel, from the points of its neighbours. Twin: reference/fluid/normal_twin.hpp.
#include "rounding.glsl"
#include "clamp_to.glsl"
#include "depth.glsl"
#include "source.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(rgba32f) writeonly uniform image2D u_NormalAfter;

struct Neighbour {
    bool exists;
    vec3 point;
};

Neighbour neighbour(ivec2 pixel, ivec2 offset) {
    float stored = stored_at(pixel, offset);
#if EDGE_NORMAL == EDGE_NORMAL_PUBLISHED
    bool exists = true;
#else
    bool exists = is_inside(pixel + offset) && !is_nothing(stored);
#endif
    return Neighbour(exists, point_of(pixel + offset, image_size(), unprojected(stored)));
}

// The step to one of two neighbours in a line; false: there are none. Of steps of one depth it is the one ahead or not.
bool step_of(vec3 here, Neighbour ahead, Neighbour behind, bool ties_ahead, out vec3 way) {
    vec3 forward = sub(ahead.point, here);
    vec3 backward = sub(here, behind.point);
#if DIFFERENCE_PICK == DIFFERENCE_PICK_NEARER
    bool picks_ahead = ahead.point.z > behind.point.z;
#else
    bool picks_ahead = ties_ahead ? !(abs(backward.z) < abs(forward.z)) : abs(forward.z) < abs(backward.z);
#endif
    way = ahead.exists && (picks_ahead || !behind.exists) ? forward : backward;
    return ahead.exists || behind.exists;
}

vec3 normal_of(ivec2 pixel, float stored) {
    vec3 here = point_of(pixel, image_size(), unprojected(stored));
    vec3 dx, dy;
    bool has_x = step_of(here, neighbour(pixel, ivec2(1, 0)), neighbour(pixel, ivec2(-1, 0)), false, dx);
    bool has_y = step_of(here, neighbour(pixel, ivec2(0, 1)), neighbour(pixel, ivec2(0, -1)), true, dy);
    if (!has_x || !has_y)
        return vec3(0.0, 0.0, 1.0);
    vec3 normal = cross_of(dx, dy);
    return ls_dot(normal, normal) == 0.0 ? vec3(0.0, 0.0, 1.0) : ls_normalize(normal);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(pixel))
        return;
    float stored = stored_at(pixel, ivec2(0));
    imageStore(u_NormalAfter, pixel, is_nothing(stored) ? vec4(0.0) : vec4(normal_of(pixel, stored), 1.0));
}
