#version 430 core
// Both edges of the ribbon at each point, facing the camera, and u at both ends of the segment that begins there. View
// space, the eye at 0. Twin: reference/lifecycle/ribbon_points_twin.hpp.

#include "lifecycle.glsl"
#include "particles.glsl"
#include "points.glsl"
#include "lengths.glsl"
#include "appearance.glsl"

layout(local_size_x = 256) in;
layout(std430) readonly buffer Distances { Length distances[]; };
layout(std430) buffer Points { float points[]; }; // left, right, u at the start and the end

uniform mat4 u_View;
uniform float u_UvScale;

bool is_zero(vec3 v) { return !(ls_dot(v, v) > 0.0); }

// 0 where the squared length is 0, infinite or NaN.
vec3 unit_of(vec3 v) {
    float squared = ls_dot(v, v);
    if (!(squared > 0.0 && squared < uintBitsToFloat(0x7f800000u)))
        return vec3(0.0);
    float l = ls_sqrt(squared);
    return vec3(ls_divide(v.x, l), ls_divide(v.y, l), ls_divide(v.z, l));
}

vec3 seen(uint i) {
    load(point_slot(i));
    return ls_transform(u_View, position()).xyz;
}

float u_at(uint i, uint n) {
#if UV == UV_STRETCHED
#if STRETCHED_DIVISOR == STRETCHED_DIVISOR_LAST_INDEX
    return ls_divide(float(i), float(n - 1u));
#else
    return i == 0u ? 0.0 : ls_divide(float(i + 1u), float(n));
#endif
#elif UV == UV_DISTANCE
#if DISTANCE_SUM == DISTANCE_SUM_FIXED
#if UV_ANCHOR == UV_ANCHOR_FIXED
    return distance_of(counters[u_Emitter].distance_origin + distances[u_Base + i]);
#else
    return distance_of(distances[u_Base + i]);
#endif
#else
    load(point_slot(i));
    return distance_from_start();
#endif
#else
    return 0.0;
#endif
}

void main() {
    uint i = gl_GlobalInvocationID.x, n = counters[u_Emitter].alive;
    if (i >= n)
        return;
    vec3 p = seen(i);
    float size = size_now();
    vec3 before_it = vec3(0.0), after_it = vec3(0.0);
    if (i > 0u)
        before_it = sub(p, seen(i - 1u));
    if (i + 1u < n)
        after_it = sub(seen(i + 1u), p);
    vec3 tangent = add(unit_of(before_it), unit_of(after_it));
    if (is_zero(tangent))
        tangent = is_zero(before_it) ? after_it : before_it;
    vec3 side = unit_of(cross_of(tangent, neg(p)));
    if (is_zero(side))
        side = vec3(1.0, 0.0, 0.0);
    float reach = mul(size, 0.5);
#if RIBBON_JOINT == RIBBON_JOINT_MITRE
    float c = ls_dot(side, unit_of(cross_of(is_zero(after_it) ? before_it : after_it, neg(p))));
    if (c >= 0.25)
        reach = mul(reach, ls_divide(1.0, c));
#endif
    vec3 edge = mul(side, reach);
    vec3 left = add(p, edge), right = sub(p, edge);
#if UV == UV_SEGMENT
    vec2 u = vec2(0.0, 1.0);
#else
    vec2 u = vec2(u_at(i, n), 0.0);
    u.y = i + 1u < n ? u_at(i + 1u, n) : u.x;
#endif
    uint at = 8u * (u_Base + i);
    for (int k = 0; k < 3; ++k) {
        points[at + k] = left[k];
        points[at + 3u + k] = right[k];
    }
    points[at + 6u] = mul(u.x, u_UvScale);
    points[at + 7u] = mul(u.y, u_UvScale);
}
