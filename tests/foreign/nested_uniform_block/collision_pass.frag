#version 420 core
layout(location = 0) flat in vec3 at_next;
layout(location = 0) out vec4 stored;

void main() { stored = vec4(at_next, 1.0); }
