#version 330 core
// A point for every point, as the collision pass has it.
layout(points) in;
layout(points, max_vertices = 1) out;

in float v_Index[];
out float out_Index;

void main() {
    out_Index = v_Index[0];
    gl_Position = gl_in[0].gl_Position;
    EmitVertex();
    EndPrimitive();
}
