// GLSL's own operations, each `precise` (a driver may compute a root otherwise elsewhere): as fast as the driver makes
// them, and as exact as it likes (division 2.5 ULP, sqrt and normalize looser still). Reference twins: the profiles in
// reference/arithmetic.hpp.

float ls_divide(float a, float b) {
    precise float quotient = a / b;
    return quotient;
}

float ls_reciprocal(float a) {
    precise float quotient = 1.0 / a;
    return quotient;
}

float ls_sqrt(float a) {
    precise float root = sqrt(a);
    return root;
}

float ls_inverse_sqrt(float a) {
    precise float root = inversesqrt(a);
    return root;
}

// Rounded each, not fused.
float ls_multiply(float a, float b) {
    precise float product = a * b;
    return product;
}

float ls_add(float a, float b) {
    precise float sum = a + b;
    return sum;
}

float ls_dot(vec3 a, vec3 b) {
    precise float product = dot(a, b);
    return product;
}

float ls_length(vec3 v) {
    precise float root = length(v);
    return root;
}

vec3 ls_normalize(vec3 v) {
    precise vec3 unit = normalize(v);
    return unit;
}

// m * vec4(v, 1); `precise` keeps the columns in order, left to right.
vec4 ls_transform(mat4 m, vec3 v) {
    precise vec4 product = m * vec4(v, 1.0);
    return product;
}

// Subnormals are left to the driver.
float ls_flush(float x) { return x; }

vec3 ls_flush3(vec3 v) { return v; }
