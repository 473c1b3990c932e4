#version 330 core
#extension GL_ARB_gpu_shader5 : require
// Calls the functions of portable.glsl for portable_twin_test.cpp, which has their twin calls in the same order.

#include "arithmetic.glsl"

in vec3 a_A;
in vec3 a_B;

uniform mat4 u_Matrix;
uniform int u_First;

out vec4 out_Result;

void main() {
#if FUNCTION == FUNCTION_QUOTIENTS
    out_Result = vec4(ls_divide(a_A.x, a_B.x), ls_divide(a_A.y, a_B.y), ls_multiply(a_A.z, a_B.z),
                      ls_add(ls_flush(a_A.x), ls_flush(a_B.x)));
#elif FUNCTION == FUNCTION_ROOTS
    out_Result = vec4(ls_sqrt(a_A.x), ls_reciprocal(a_A.x), ls_inverse_sqrt(a_A.x), ls_flush(a_A.y));
#elif FUNCTION == FUNCTION_SIGNIFICANDS
    float x = intBitsToFloat(ls_one + u_First + gl_VertexID);
    out_Result = vec4(ls_sqrt(x), ls_reciprocal(x), ls_inverse_sqrt(x), 0.0);
#elif FUNCTION == FUNCTION_VECTORS
    out_Result = vec4(ls_normalize(a_A), ls_length(a_A));
#elif FUNCTION == FUNCTION_TRANSFORM
    out_Result = ls_transform(u_Matrix, a_A);
#endif
}
