#version 330 core
flat in uint lamp;
out uint mark;

void main() {
    mark = lamp;
}
