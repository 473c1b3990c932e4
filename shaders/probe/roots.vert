#version 330 core
#extension GL_ARB_gpu_shader5 : require
// The driver's own 1/x and inversesqrt(x), for a table over every significand.
in float a_X;
precise out float out_Reciprocal;
precise out float out_InverseSqrt;

void main() {
    out_Reciprocal = 1.0 / a_X;
    out_InverseSqrt = inversesqrt(a_X);
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
}
