#version 430 core
// One input an invocation.
layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Inputs { float inputs[]; };    // a vec3 and two factors each
layout(std430, binding = 1) writeonly buffer Results { float results[]; }; // nine each

#include "probe/chains.glsl"

void write(uint place, vec3 v) {
    results[place] = v.x;
    results[place + 1u] = v.y;
    results[place + 2u] = v.z;
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    vec3 v = vec3(inputs[5u * i], inputs[5u * i + 1u], inputs[5u * i + 2u]);
    float s = inputs[5u * i + 3u], t = inputs[5u * i + 4u];
    write(9u * i, scaled_twice(v, s, t));
    write(9u * i + 3u, scaled_and_divided(v, s, t));
    write(9u * i + 6u, divided_and_scaled(v, s, t));
}
