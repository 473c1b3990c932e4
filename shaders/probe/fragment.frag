#version 330 core
#extension GL_ARB_gpu_shader5 : require
// The operations that a driver may compute otherwise than in the vertex stage, each on components of its own.
uniform sampler2D u_A;
uniform sampler2D u_B;
layout(location = 0) out vec4 o_Scalars;
layout(location = 1) out vec4 o_Sums;

void main() {
    vec4 a = texelFetch(u_A, ivec2(gl_FragCoord.xy), 0);
    vec4 b = texelFetch(u_B, ivec2(gl_FragCoord.xy), 0);
    o_Scalars = vec4(a.w / b.w, sqrt(abs(a.w)), inversesqrt(abs(b.w)), 1.0 / b.w);
    precise float multiply_add = a.x * b.y + b.z;
    o_Sums = vec4(dot(a.xyz, b.xyz), length(a.xyz), a.y * b.z + b.x, multiply_add);
}
