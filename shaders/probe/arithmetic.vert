#version 330 core
#extension GL_ARB_gpu_shader5 : require
// The operations GLSL leaves open, each on attributes of its own, so that none shares a subexpression with another.
// PRECISE is `precise` or nothing.

in vec3 a_DotA;
in vec3 a_DotB;
in vec3 a_MultiplyAdd;
in vec3 a_CommonFactor;
in vec3 a_CrossA;
in vec3 a_CrossB;
in vec3 a_Transform;
in vec3 a_TransformWritten;
in vec3 a_Squares;
in vec3 a_Fma;
in vec4 a_Quotient;
in vec3 a_Roots;
in vec3 a_Length;
in vec3 a_Normalize;
in vec3 a_Transcendental;
in float a_Copy;

uniform mat4 u_Matrix;

PRECISE out float out_Dot;
PRECISE out float out_MultiplyAdd;
PRECISE out float out_CommonFactor;
PRECISE out vec3 out_Cross;
PRECISE out vec4 out_Transform;
PRECISE out vec4 out_TransformWritten;
PRECISE out float out_Squares;
PRECISE out float out_Fma;
PRECISE out float out_Quotient;
PRECISE out vec4 out_ByConstants;
PRECISE out float out_Reciprocal;
PRECISE out float out_Sqrt;
PRECISE out float out_InverseSqrt;
PRECISE out float out_Length;
PRECISE out vec3 out_Normalize;
PRECISE out vec3 out_Transcendental;
PRECISE out float out_Copy;
PRECISE out float out_Positive;

void main() {
    out_Dot = dot(a_DotA, a_DotB);
    out_MultiplyAdd = a_MultiplyAdd.x * a_MultiplyAdd.y + a_MultiplyAdd.z;
    out_CommonFactor = a_CommonFactor.x * a_CommonFactor.y + a_CommonFactor.x * a_CommonFactor.z;
    out_Cross = cross(a_CrossA, a_CrossB);
    out_Transform = u_Matrix * vec4(a_Transform, 1.0);
    out_TransformWritten = ((u_Matrix[0] * a_TransformWritten.x + u_Matrix[1] * a_TransformWritten.y) +
                            u_Matrix[2] * a_TransformWritten.z) + u_Matrix[3];
    out_Squares = a_Squares.x * a_Squares.x + a_Squares.y * a_Squares.y + a_Squares.z * a_Squares.z;
    out_Fma = fma(a_Fma.x, a_Fma.y, a_Fma.z);
    out_Quotient = a_Quotient.x / a_Quotient.y;
    out_ByConstants = vec4(a_Quotient.x / 79238.288, a_Quotient.y / 3.0, a_Quotient.z / 255.0, a_Quotient.w / 82801.277);
    out_Reciprocal = 1.0 / a_Roots.x;
    out_Sqrt = sqrt(a_Roots.y);
    out_InverseSqrt = inversesqrt(a_Roots.z);
    out_Length = length(a_Length);
    out_Normalize = normalize(a_Normalize);
    out_Transcendental = vec3(sin(a_Transcendental.x), exp2(a_Transcendental.y), pow(a_Transcendental.z, 2.2));
    out_Copy = a_Copy;
    out_Positive = a_Copy > 0.0 ? 1.0 : 0.0;
    gl_Position = vec4(0.0);
}
