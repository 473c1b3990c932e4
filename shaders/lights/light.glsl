// The lights, and what one adds to a voxel. Twin: reference/lights/contribution.hpp.
#include "rounding.glsl"

struct Light {
    vec3 position;
    float range;
    vec3 direction;
    float speed;
    vec3 colour;
    float inv_range2;
    vec4 spare;
};

uniform vec3 u_GridOrigin;
uniform float u_VoxelSize;
uniform float u_InvVoxelSize;
uniform float u_VoxelOffset;
uniform ivec3 u_GridSize;

bool is_number(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }
bool is_number(vec3 v) { return is_number(v.x) && is_number(v.y) && is_number(v.z); }

bool is_finite_light(Light light) {
    return is_number(light.position) && is_number(light.range) && is_number(light.direction) &&
           is_number(light.speed) && is_number(light.colour) && is_number(light.inv_range2);
}

float squared(vec3 v) { return add(add(mul(v.x, v.x), mul(v.y, v.y)), mul(v.z, v.z)); }

float cell_along(float p, int axis) {
    precise float cell = floor((p - u_GridOrigin[axis]) * u_InvVoxelSize);
    return cell;
}
ivec3 cell_of(vec3 p) { return ivec3(cell_along(p.x, 0), cell_along(p.y, 1), cell_along(p.z, 2)); }

float point_along(int i, int axis) {
    return add(u_GridOrigin[axis], mul(add(float(i), u_VoxelOffset), u_VoxelSize));
}
vec3 voxel_point(ivec3 v) { return vec3(point_along(v.x, 0), point_along(v.y, 1), point_along(v.z, 2)); }

struct Contribution {
    vec3 colour;
    vec3 direction;
    float weight;
};

// Whether the light reaches the voxel, and what it then adds, besides 1 to the count.
bool contributes(Light light, ivec3 voxel, out Contribution made) {
#if INFLUENCE == INFLUENCE_OWN_VOXEL
    if (cell_of(light.position) != voxel)
        return false;
#endif
    vec3 q = sub(ls_flush3(light.position), voxel_point(voxel));
    float s = squared(q);
    float range = ls_flush(light.range);
    if (!(s <= mul(range, range)))
        return false;
#if ATTENUATION == ATTENUATION_NONE
    float w = 1.0;
#else
    float t = mul(s, ls_flush(light.inv_range2));
#if ATTENUATION == ATTENUATION_SMOOTH
    float k = sub(1.0, t);
    float w = mul(k, k);
#else
    float k = sub(1.0, mul(t, t));
    float w = ls_divide(mul(k, k), add(s, 1.0));
#endif
#endif
    made.colour = mul(ls_flush3(light.colour), w);
    made.weight = w;
    made.direction = vec3(0.0);
    vec3 d = q;
#if DIRECTION == DIRECTION_UNIT
#if ZERO_DISTANCE == ZERO_DISTANCE_SKIP
    if (s == 0.0)
        return true;
#endif
    d = mul(q, ls_divide(1.0, ls_sqrt(s)));
#endif
#if DIRECTION_WEIGHT == DIRECTION_WEIGHT_ATTENUATION
    d = mul(d, w);
#endif
    made.direction = d;
    return true;
}
