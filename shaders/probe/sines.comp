#version 430 core
// The functions of angles, to which GLSL gives no precision: sin, cos and tan of three angles each.

layout(local_size_x = 64) in;

layout(std430, binding = 0) buffer Angles { float angles[]; }; // and then what is made of them

void main() {
    uint i = 3u * gl_GlobalInvocationID.x;
    precise float sine = sin(angles[i]);
    precise float cosine = cos(angles[i + 1u]);
    precise float tangent = tan(angles[i + 2u]);
    angles[i] = sine;
    angles[i + 1u] = cosine;
    angles[i + 2u] = tangent;
}
