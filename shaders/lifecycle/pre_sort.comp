#version 430 core
// The keys of the living, and behind them padding. Twin: reference/lifecycle/sort_twin.hpp.

#include "lifecycle.glsl"
#include "particles.glsl"
#include "lists.glsl"
#include "keys.glsl"

layout(local_size_x = 256) in;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= u_Keys)
        return;
    Key key = Key(0xffffffffu, 0xffffffffu, 0xffffffffu);
#if LAYOUT == LAYOUT_112
    if (i < counters[u_Emitter].alive) {
        uint slot = slot_at(i);
        load(slot);
        key = Key(w[21], w[22], slot);
    }
#endif
    keys[u_FirstKey + i] = key;
}
