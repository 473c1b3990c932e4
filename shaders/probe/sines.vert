#version 330 core
#extension GL_ARB_gpu_shader5 : require
// The functions of angles, to which GLSL gives no precision.

in vec3 a_Angles;

precise out vec3 out_Made;

void main() {
    out_Made = vec3(sin(a_Angles.x), cos(a_Angles.y), tan(a_Angles.z));
    gl_Position = vec4(0.0);
}
