#version 430 core
// Appends this frame's newborns behind the particles that are there. Twin: reference/lifecycle/emit_twin.hpp.

#include "lifecycle.glsl"
#include "particles.glsl"
#include "emission.glsl"
#include "lists.glsl"

layout(local_size_x = 256) in;
layout(std430) buffer Arguments { ArgumentWords arguments[]; };

uniform uint u_Request;

// Of newborn k; where slots are given, the last of the dead first.
#if MANAGEMENT == MANAGEMENT_INDEX_LISTS
layout(std430) readonly buffer Dead { uint dead[]; };

uint slot_of_newborn(uint k, uint alive) {
    uint slot = dead[u_Base + u_Capacity - alive - 1u - k];
    survivors[living_list() + alive + k] = slot;
    return slot;
}
#else
uint slot_of_newborn(uint k, uint alive) { return alive + k; }
#endif

void main() {
    uint k = gl_GlobalInvocationID.x;
    uint alive = counters[u_Emitter].alive;
#if OVERFLOW == OVERFLOW_DROP_NEW
    uint emitted = min(u_Request, u_Capacity - alive);
#else
    uint emitted = u_Request;
#endif
    if (k == 0u) {
        counters[u_Emitter].emitted = emitted;
#if EMIT_WHEN == EMIT_WHEN_BEFORE_DESTROY
        arguments[u_Emitter].move = uint[3](groups_of(alive + emitted), 1u, 1u);
#if DIES == DIES_ALL
        counters[u_Emitter].may_die = alive + emitted;
        arguments[u_Emitter].destroy = uint[3](DESTROY_GROUPS(alive + emitted), 1u, 1u);
#endif
#endif
    }
    if (k >= emitted)
        return;
    uint slot = slot_of_newborn(k, alive);
    be_born(slot, k, emitted);
    store(slot);
}
