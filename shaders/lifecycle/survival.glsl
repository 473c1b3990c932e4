// Who survives the frame, of those that may die. Twin: reference/lifecycle/survival.hpp.
#include "lists.glsl"

bool survives(uint place) {
    uint n = present();
    if (n > u_Capacity && place < n - u_Capacity)
        return false;
    load(slot_at(place));
    return remaining() > 0.0;
}

// Threads take four in a row each, a group 1,024.
uint flags_of(uint first, uint d) {
    uint flags = 0u;
    for (uint k = 0u; k < 4u; ++k)
        if (first + k < d && survives(first + k))
            flags |= 1u << k;
    return flags;
}
