#version 330 core
out float glass;

void main() {
    glass = 0.2;
}
