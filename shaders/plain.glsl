// GLSL's own operations: as fast as the driver makes them, and as exact as it likes (division 2.5 ULP, sqrt and
// normalize looser still). Reference twins: the profiles in reference/arithmetic.hpp.

float ls_divide(float a, float b) { return a / b; }

float ls_reciprocal(float a) { return 1.0 / a; }

float ls_sqrt(float a) { return sqrt(a); }

float ls_inverse_sqrt(float a) { return inversesqrt(a); }

// Rounded each, not fused.
float ls_multiply(float a, float b) {
    precise float product = a * b;
    return product;
}

float ls_add(float a, float b) {
    precise float sum = a + b;
    return sum;
}

float ls_dot(vec3 a, vec3 b) { return dot(a, b); }

float ls_length(vec3 v) { return length(v); }

vec3 ls_normalize(vec3 v) { return normalize(v); }

// m * vec4(v, 1); `precise` keeps the columns in order, left to right.
vec4 ls_transform(mat4 m, vec3 v) {
    precise vec4 product = m * vec4(v, 1.0);
    return product;
}

// Subnormals are left to the driver.
float ls_flush(float x) { return x; }

vec3 ls_flush3(vec3 v) { return v; }
