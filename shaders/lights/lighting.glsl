// What a point sends to the eye. Twin: reference/lights/lighting_twin.hpp. Needs rounding.glsl.
#include "sampling.glsl"

uniform vec3 u_GridOrigin;
uniform float u_InvVoxelSize;
uniform vec3 u_Ambient;
uniform vec3 u_Background;

vec3 radiance(vec3 position, vec3 normal, vec3 albedo) {
    Sample s = mean_at(mul(sub(position, u_GridOrigin), u_InvVoxelSize));
    vec3 d = s.direction.xyz;
    float m = add(add(mul(d.x, d.x), mul(d.y, d.y)), mul(d.z, d.z));
    float diffuse;
#if ZERO_DIRECTION != ZERO_DIRECTION_UNDEFINED
    if (m == 0.0) {
#if ZERO_DIRECTION == ZERO_DIRECTION_ISOTROPIC
        diffuse = 0.25;
#else
        diffuse = 0.0;
#endif
    } else
#endif
    {
        float distance = ls_sqrt(m);
        vec3 l = mul(d, ls_divide(1.0, distance));
        float cosine = add(add(mul(normal.x, l.x), mul(normal.y, l.y)), mul(normal.z, l.z));
        diffuse = cosine > 0.0 ? cosine : 0.0;
#if SHADING == SHADING_DIRECTIONALITY
        float k = ls_divide(distance, s.direction.w);
        k = k < 1.0 ? k : 1.0;
        diffuse = add(mul(k, diffuse), mul(sub(1.0, k), 0.25));
#endif
    }
    vec3 light = add(u_Ambient, mul(s.colour.xyz, diffuse));
    return vec3(mul(albedo.x, light.x), mul(albedo.y, light.y), mul(albedo.z, light.z));
}
