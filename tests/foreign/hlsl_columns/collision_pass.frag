#version 450
// The location of the vertex stage's output, which the shipped fragment stage does not have.
layout(location = 0) flat in vec3 position;
layout(location = 0) out vec4 texel;
void main() { texel = vec4(position, 1.0); }
