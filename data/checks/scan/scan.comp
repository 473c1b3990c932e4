#version 430
// Running sums of tiles of 128 values, in shared memory (Hillis and Steele, "Data parallel algorithms", 1986).
layout(local_size_x = 128) in;
layout(std430) readonly buffer Values { uint values[]; };
layout(std430) buffer Sums { uint sums[]; };
layout(std430) buffer Totals { uint totals[]; };

shared uint tile[128];

void main() {
    uint i = gl_GlobalInvocationID.x, at = gl_LocalInvocationID.x;
    tile[at] = values[i];
    barrier();
    for (uint step = 1u; step < 128u; step *= 2u) {
        uint left = at >= step ? tile[at - step] : 0u;
        barrier();
        tile[at] += left;
        barrier();
    }
    sums[i] = tile[at];
    if (at == 127u)
        totals[gl_WorkGroupID.x] = tile[at];
}
