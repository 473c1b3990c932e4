#version 330 core
flat out int v_Index;

void main() {
    v_Index = gl_VertexID;
    gl_Position = vec4(0.0);
}
