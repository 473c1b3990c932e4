#version 330 core
#include "clip_volume.glsl"

layout(points) in;
layout(points, max_vertices = 1) out;

in vec3 v_Position[];

flat out vec3 g_Position;

void main() {
    g_Position = v_Position[0];
    gl_Position = kept_position(gl_in[0].gl_Position);
    EmitVertex();
    EndPrimitive();
}
