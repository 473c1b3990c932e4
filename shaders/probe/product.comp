#version 430 core
// One product, sum or comparison an invocation.
layout(local_size_x = 64) in;

layout(std430, binding = 0) buffer Values { float values[]; };
uniform float u_Operand;
uniform int u_What; // 0: a product, 1: a sum, 2: whether the value is below the operand

void main() {
    float value = values[gl_GlobalInvocationID.x];
    precise float product = value * u_Operand;
    precise float sum = value + u_Operand;
    float below = value < u_Operand ? 1.0 : 0.0;
    values[gl_GlobalInvocationID.x] = u_What == 0 ? product : u_What == 1 ? sum : below;
}
