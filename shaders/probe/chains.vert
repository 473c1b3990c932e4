#version 330 core
#extension GL_ARB_gpu_shader5 : require

in vec3 a_Vector;
in vec2 a_Factors;

out vec3 out_ScaledTwice;
out vec3 out_ScaledAndDivided;
out vec3 out_DividedAndScaled;

#include "probe/chains.glsl"

void main() {
    out_ScaledTwice = scaled_twice(a_Vector, a_Factors.x, a_Factors.y);
    out_ScaledAndDivided = scaled_and_divided(a_Vector, a_Factors.x, a_Factors.y);
    out_DividedAndScaled = divided_and_scaled(a_Vector, a_Factors.x, a_Factors.y);
    gl_Position = vec4(0.0);
}
