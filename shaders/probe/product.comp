#version 430 core
// One product or sum an invocation.
layout(local_size_x = 64) in;

layout(std430, binding = 0) buffer Values { float values[]; };
uniform float u_Operand;
uniform int u_Adds;

void main() {
    float value = values[gl_GlobalInvocationID.x];
    precise float product = value * u_Operand;
    precise float sum = value + u_Operand;
    values[gl_GlobalInvocationID.x] = u_Adds != 0 ? sum : product;
}
