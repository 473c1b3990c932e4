#version 430 core
// The grains' blocks by other names, the velocities as vectors of three floats in a structure.
#include "rounding.glsl"
layout(local_size_x = 64) in;

struct Grain { vec3 place; int lives; };
struct Motion { float x, y, z; };
layout(std430) readonly buffer Grains { Grain grains[]; };
layout(std430) buffer Motions { Motion motions[]; };

uniform vec3 centre;
uniform float range2, strength, weight, seconds;
uniform uint many;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= many || grains[i].lives != 1)
        return;
    vec3 way = sub(ls_flush3(grains[i].place), centre);
    float d2 = add(add(mul(way.x, way.x), mul(way.y, way.y)), mul(way.z, way.z));
    if (d2 < range2) {
        vec3 along = ls_normalize(way);
#if SAFE_DIRECTION == SAFE_DIRECTION_ON
        if (!(d2 > 0.0))
            along = vec3(0.0);
#endif
        vec3 blast = mul(along, mul(sub(1.0, ls_divide(d2, range2)), strength));
        vec3 v = ls_flush3(vec3(motions[i].x, motions[i].y, motions[i].z));
        v.x = add(v.x, mul(ls_divide(blast.x, weight), seconds));
        v.y = add(v.y, mul(ls_divide(blast.y, weight), seconds));
        v.z = add(v.z, mul(ls_divide(blast.z, weight), seconds));
        motions[i] = Motion(v.x, v.y, v.z);
    }
}
