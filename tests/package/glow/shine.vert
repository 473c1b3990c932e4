#version 330 core
in vec2 a_Place;
in float a_Depth;
in float a_Power;
flat out float power;

void main() {
    power = a_Power;
    gl_PointSize = 1.0;
    gl_Position = vec4((a_Place + 0.5) / vec2(4.0, 2.0) - 1.0, a_Depth, 1.0);
}
