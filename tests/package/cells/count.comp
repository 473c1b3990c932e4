#version 430 core
layout(local_size_x = 1) in;
struct Counts { uint groups[3]; uint living; };
layout(std430) buffer countBuffer { Counts counts[]; };
uniform uint u_Frame;

void main() {
    uint living = (u_Frame * 37u) % 300u;
    counts[1].living = living;
    counts[1].groups[0] = (living + 63u) / 64u;
    counts[1].groups[1] = 1u;
    counts[1].groups[2] = 1u;
}
