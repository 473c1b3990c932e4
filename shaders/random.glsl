// pcg3d (Jarzynski and Olano, "Hash functions for GPU rendering", JCGT 9(3), 2020). Twin: reference/system/pcg3d.hpp.
#ifndef RANDOM_GLSL
#define RANDOM_GLSL

uvec3 pcg3d(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

// In [0, 1).
float unit(uint bits) { return mul(float(bits >> 8), 1.0 / 16777216.0); }
vec3 unit3(uvec3 bits) { return vec3(unit(bits.x), unit(bits.y), unit(bits.z)); }
#endif
