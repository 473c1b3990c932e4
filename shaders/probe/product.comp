#version 430 core
// One product an invocation.
layout(local_size_x = 64) in;

layout(std430, binding = 0) buffer Values { float values[]; };
uniform float u_Factor;

void main() {
    precise float product = values[gl_GlobalInvocationID.x] * u_Factor;
    values[gl_GlobalInvocationID.x] = product;
}
