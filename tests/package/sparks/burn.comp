#version 430 core
layout(local_size_x = 64) in;
layout(std430) buffer heatBuffer { float heat[]; };
layout(std430) buffer litBuffer { int lit[]; };
layout(std430) buffer burntBuffer { uint burnt; };
layout(std430) readonly buffer lossBuffer { float loss[]; };
uniform uint u_ItemCount;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= u_ItemCount || lit[i] == 0)
        return;
    precise float left = heat[i] - loss[0] * FACTOR;
    heat[i] = left;
    if (left < 0.0) {
        lit[i] = 0;
        atomicAdd(burnt, 1u);
    }
}
