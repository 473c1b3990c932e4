#version 430 core
// A light's way in a frame, between the walls of the grid. Twin: reference/lights/step_twin.hpp.
#include "light.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer LightsBefore { Light before[]; };
layout(std430) writeonly buffer LightsAfter { Light after[]; };

uniform uint u_LightCount;
uniform vec3 u_GridEnd;
uniform float u_Tick;

void bounce(inout float p, inout float d, float low, float high) {
    if (p < low) {
        p = add(low, sub(low, p));
        d = neg(d);
    } else if (p > high) {
        p = sub(high, sub(p, high));
        d = neg(d);
    }
    if (p < low)
        p = low;
    else if (p > high)
        p = high;
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= u_LightCount)
        return;
    Light light = before[i];
    vec3 p = ls_flush3(light.position);
    vec3 d = ls_flush3(light.direction);
#if MOTION == MOTION_BOUNCE
    if (is_finite_light(light)) {
        p = add(p, mul(mul(d, ls_flush(light.speed)), u_Tick));
        bounce(p.x, d.x, u_GridOrigin.x, u_GridEnd.x);
        bounce(p.y, d.y, u_GridOrigin.y, u_GridEnd.y);
        bounce(p.z, d.z, u_GridOrigin.z, u_GridEnd.z);
    }
#endif
    light.position = p;
    light.direction = d;
    after[i] = light;
}
