#version 430 core
// How far each point is from the ribbon's start. Twin: reference/lifecycle/ribbon_twin.hpp.

#include "lifecycle.glsl"
#include "particles.glsl"
#include "points.glsl"
#include "lengths.glsl"

layout(local_size_x = 256) in;
layout(std430) buffer Distances { Length distances[]; };
layout(std430) readonly buffer LengthSums { Length length_sums[]; };

uniform uint u_FirstBlock;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= counters[u_Emitter].alive)
        return;
    Length sum = distances[u_Base + i];
    if (i >= 256u)
        sum = plus(length_sums[u_FirstBlock + (i >> 8) - 1u], sum);
    distances[u_Base + i] = sum;
    uint slot = point_slot(i);
    load(slot);
    dither_slot = slot;
    set_distance_from_start(distance_of(sum));
    store(slot);
}
