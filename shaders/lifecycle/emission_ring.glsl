// The emission counts of the last frames: those too young to die. Twin: reference/lifecycle/emission_ring.hpp.
layout(std430) buffer Ring { uint ring[]; };

uniform uint u_FirstInRing, u_Window; // W; 0: none is ever too young, or nobody dies

void count_emission(uint request) {
    uint emitted = counters[u_Emitter].emitted;
    counters[u_Emitter].serial += emitted;
    counters[u_Emitter].dropped = request - emitted;
    counters[u_Emitter].dropped_total += request - emitted;
    if (u_Window == 0u)
        return;
    uint head = counters[u_Emitter].ring_head;
    counters[u_Emitter].young += emitted - ring[u_FirstInRing + head];
    ring[u_FirstInRing + head] = emitted;
    counters[u_Emitter].ring_head = head + 1u == u_Window ? 0u : head + 1u;
}
