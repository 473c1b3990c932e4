#version 430 core
// Lists the survivors among those that may die: by their prefix sum in order, by an atomic counter in any. Twin:
// reference/lifecycle/destroy_twin.hpp.

#include "lifecycle.glsl"
#include "particles.glsl"
#include "survival.glsl"

layout(local_size_x = 256) in;
#if MANAGEMENT == MANAGEMENT_INDEX_LISTS
layout(std430) buffer Dead { uint dead[]; };

// Behind the slots that are free already.
void bury(uint place, uint rank) { dead[u_Base + u_Capacity - counters[u_Emitter].may_die + rank] = slot_at(place); }
#else
layout(std430) buffer Survivors { uint survivors[]; };

void bury(uint place, uint rank) {}
#endif

#if COMPACTION == COMPACTION_SCAN
#include "group_scan.glsl"
layout(std430) readonly buffer ScanSums { uint scan_sums[]; };
uniform uint u_FirstBlock;

void main() {
    uint d = counters[u_Emitter].may_die;
    uint first = gl_GlobalInvocationID.x * 4u;
    uint flags = flags_of(first, d);
    uint total;
    uint below = group_scan(uint(bitCount(flags)), total);
    if (gl_WorkGroupID.x >= blocks_of(d))
        return;
    uint rank = scan_sums[u_FirstBlock + gl_WorkGroupID.x] + below;
    for (uint k = 0u; k < 4u; ++k)
        if ((flags & (1u << k)) != 0u)
            survivors[next_list() + rank++] = slot_at(first + k);
        else if (first + k < d)
            bury(first + k, first + k - rank);
}
#else
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= counters[u_Emitter].may_die)
        return;
    if (survives(i))
        survivors[next_list() + atomicAdd(counters[u_Emitter].append, 1u)] = slot_at(i);
#if MANAGEMENT == MANAGEMENT_INDEX_LISTS
    else
        bury(i, atomicAdd(counters[u_Emitter].buried, 1u));
#endif
}
#endif
