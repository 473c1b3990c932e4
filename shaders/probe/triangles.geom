#version 330 core
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

flat in float v_Id[];
flat out float g_Id;

void main() {
    for (int i = 0; i < 3; ++i) {
        g_Id = v_Id[i];
        gl_Position = gl_in[i].gl_Position;
        EmitVertex();
    }
    EndPrimitive();
}
