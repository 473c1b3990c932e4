#version 330 core
layout(points) in;
layout(points, max_vertices = 1) out;

flat in float v_Id[];
flat out float g_Id;

void main() {
    g_Id = v_Id[0];
    gl_Position = gl_in[0].gl_Position;
    EmitVertex();
    EndPrimitive();
}
