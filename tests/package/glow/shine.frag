#version 330 core
flat in float power;
out float light;

void main() {
    light = power;
}
