#version 430 core
// The sums of distances within each block of 256. Twin: reference/lifecycle/ribbon_twin.hpp.

#include "lifecycle.glsl"
#include "particles.glsl"
#include "points.glsl"
#include "lengths.glsl"
#include "length_scan.glsl"

layout(local_size_x = 256) in;
layout(std430) buffer Distances { Length distances[]; };
layout(std430) buffer LengthSums { Length length_sums[]; };

uniform uint u_FirstBlock;

void main() {
    uint i = gl_GlobalInvocationID.x, n = counters[u_Emitter].alive;
    Length own = NO_LENGTH;
    if (i < n) {
        load(point_slot(i));
        own = length_of(distance_from_previous());
    }
    Length sum = length_scan(own);
    if (i < n)
        distances[u_Base + i] = sum;
    if (gl_LocalInvocationID.x == 255u && gl_WorkGroupID.x < groups_of(n))
        length_sums[u_FirstBlock + gl_WorkGroupID.x] = sum;
}
