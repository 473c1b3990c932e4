// The grains.
#include "rounding.glsl"

layout(local_size_x = 64) in;

struct Dust {
    vec3 position;
    int isAlive;
};

layout(std430) buffer dustBuffer { Dust dust[]; };
layout(std430) buffer velocityBuffer { float velocity[]; }; // three a grain; a vec3 would take the room of four
layout(std430) buffer aliveNumberBuffer { uint aliveNumber; };

uniform uint dustCount;

vec3 position_of(uint i) { return ls_flush3(dust[i].position); }
vec3 velocity_of(uint i) { return ls_flush3(vec3(velocity[3u * i], velocity[3u * i + 1u], velocity[3u * i + 2u])); }

void set_velocity(uint i, vec3 v) {
    velocity[3u * i] = v.x;
    velocity[3u * i + 1u] = v.y;
    velocity[3u * i + 2u] = v.z;
}

void die(uint i) {
    dust[i].isAlive = 0;
    atomicAdd(aliveNumber, 0xffffffffu);
}

void come_alive(uint i) {
    dust[i].isAlive = 1;
    atomicAdd(aliveNumber, 1u);
}

vec3 divided(vec3 v, float s) { return vec3(ls_divide(v.x, s), ls_divide(v.y, s), ls_divide(v.z, s)); }

float squared(vec3 v) { return add(add(mul(v.x, v.x), mul(v.y, v.y)), mul(v.z, v.z)); }

// With safe_direction that of nothing, or of NaN, is 0.
vec3 direction_of(vec3 way) {
#if SAFE_DIRECTION == SAFE_DIRECTION_ON
    if (!(squared(way) > 0.0))
        return vec3(0.0);
#endif
    return ls_normalize(way);
}

// a + t (b - a)
float lerp(float a, float b, float t) { return add(a, mul(sub(b, a), t)); }
vec3 lerp(vec3 a, vec3 b, float t) { return add(a, mul(sub(b, a), t)); }

// m (v, 0) and m (v, 1), left to right.
vec3 direction(mat4 m, vec3 v) {
    vec3 turned;
    for (int row = 0; row < 3; ++row)
        turned[row] = add(add(mul(v.x, m[0][row]), mul(v.y, m[1][row])), mul(v.z, m[2][row]));
    return turned;
}
vec3 place(mat4 m, vec3 v) { return add(direction(m, v), m[3].xyz); }
