#version 330 core
in float a_Index;
out float v_Index;

void main() {
    v_Index = a_Index;
    gl_Position = vec4(0.0);
}
