// Arithmetic of which each operation is rounded by itself.
#include "arithmetic.glsl"

float mul(float a, float b) {
#if ARITHMETIC == ARITHMETIC_EXACT
    return ls_multiply(a, b);
#else
    // NVIDIA's compute stage fuses a `precise` product of one function into a sum of another, but no fma.
    precise float product = fma(a, b, -0.0);
    return product;
#endif
}
float add(float a, float b) { return ls_add(a, b); }
float sub(float a, float b) { return ls_add(a, -b); }
vec3 mul(vec3 v, float s) { return vec3(mul(v.x, s), mul(v.y, s), mul(v.z, s)); }
vec3 add(vec3 a, vec3 b) { return vec3(add(a.x, b.x), add(a.y, b.y), add(a.z, b.z)); }
vec3 sub(vec3 a, vec3 b) { return vec3(sub(a.x, b.x), sub(a.y, b.y), sub(a.z, b.z)); }
float neg(float a) { return ls_flush(-a); }
vec3 neg(vec3 v) { return vec3(neg(v.x), neg(v.y), neg(v.z)); }
vec3 cross_of(vec3 a, vec3 b) {
    return vec3(sub(mul(a.y, b.z), mul(a.z, b.y)), sub(mul(a.z, b.x), mul(a.x, b.z)), sub(mul(a.x, b.y), mul(a.y, b.x)));
}
