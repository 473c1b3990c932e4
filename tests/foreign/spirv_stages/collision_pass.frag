#version 450 core
layout(location = 0) flat in vec3 place;
layout(location = 0) out vec4 texel;
void main() { texel = vec4(place, 1.0); }
