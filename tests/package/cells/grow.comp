#version 430 core
layout(local_size_x = 64) in;
struct Counts { uint groups[3]; uint living; };
layout(std430) readonly buffer countBuffer { Counts counts[]; };
layout(std430) readonly buffer CellsBefore { float before[]; };
layout(std430) buffer CellsAfter { float after[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= counts[1].living)
        return;
    uint from = counts[1].living - 1u - i; // reads what others write, in the other copy
    precise float grown = before[from] + 1.5;
    after[i] = grown;
}
