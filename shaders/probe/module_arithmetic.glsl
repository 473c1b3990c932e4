#version 450 core
// What module_arithmetic.vert.spv was made of:
// glslangValidator -G -S vert -o module_arithmetic.vert.spv module_arithmetic.glsl
layout(location = 0) in vec3 a_DotA;
layout(location = 1) in vec3 a_DotB;
layout(location = 2) in vec3 a_Length;
layout(location = 3) in vec3 a_Normalize;

layout(location = 0) precise out float out_Dot;
layout(location = 1) precise out float out_Length;
layout(location = 2) precise out vec3 out_Normalize;

void main() {
    out_Dot = dot(a_DotA, a_DotB);
    out_Length = length(a_Length);
    out_Normalize = normalize(a_Normalize);
    gl_Position = vec4(0.0);
}
