// What nodes of a graph are made of. Twin: reference/system/graph_twin.hpp.
#ifndef GRAPH_NODES_GLSL
#define GRAPH_NODES_GLSL

#include "random.glsl"
#include "turns.glsl"
#include "force_fields.glsl"

// Of NaN the second.
float smaller(float a, float b) { return a < b ? a : b; }
float greater(float a, float b) { return b < a ? a : b; }

float smoothly(float t) { return mul(mul(t, t), sub(3.0, mul(t, 2.0))); }

vec3 potentials(vec3 x, uint seed) { return in_noise(x) ? all_noise(x, seed) : vec3(0.0); }
vec3 potential_gradient(vec3 x, int which, uint seed) {
    return in_noise(x) ? noise_of(cell_of(x, seed), which).xyz : vec3(0.0);
}

vec3 attracted(vec3 p, vec3 centre, float strength, float radius, float exponent, float square) {
    vec3 way = sub(centre, p);
    return attraction(vec3(0.0), way, ls_length(way), strength, radius, exponent, square);
}

// Shapes, of three numbers in [0, 1).
vec3 in_box(vec3 u, vec3 low, vec3 high) {
    vec3 size = sub(high, low);
    return add(low, vec3(mul(u.x, size.x), mul(u.y, size.y), mul(u.z, size.z)));
}
vec3 on_sphere(vec3 u) { return on_circle(sub(mul(u.x, 2.0), 1.0), u.y); }
vec3 in_cone(vec3 u, vec3 side, vec3 up, vec3 ahead, float depth) {
    vec3 local = on_circle(sub(1.0, mul(u.x, depth)), u.y);
    return add(add(mul(side, local.x), mul(up, local.y)), mul(ahead, local.z));
}
#endif
