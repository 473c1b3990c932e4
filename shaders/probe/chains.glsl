// Products of products as a library writes them: each `precise` in a function of its own, and a vector put together
// again. A driver may take (v * s) * t for v * (s * t) there.

float product(float a, float b) {
    precise float p = a * b;
    return p;
}

float quotient(float a, float b) {
    precise float q = a / b;
    return q;
}

vec3 scaled(vec3 v, float s) { return vec3(product(v.x, s), product(v.y, s), product(v.z, s)); }
vec3 divided(vec3 v, float s) { return vec3(quotient(v.x, s), quotient(v.y, s), quotient(v.z, s)); }

// With a way out before the product, which takes another path through compilers.
vec3 scaled_twice(vec3 v, float s, float t) {
    if (!(abs(s) < 1e30))
        return vec3(0.0);
    return scaled(scaled(v, s), t);
}

vec3 scaled_and_divided(vec3 v, float s, float t) {
    if (!(abs(s) < 1e30))
        return vec3(0.0);
    return divided(scaled(v, s), t);
}

vec3 divided_and_scaled(vec3 v, float s, float t) {
    if (!(abs(s) < 1e30))
        return vec3(0.0);
    return scaled(divided(v, s), t);
}
