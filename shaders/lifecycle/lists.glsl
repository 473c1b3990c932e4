// Where particles stand, if they stay in their slots: in one half of the survivors; the other half is the next frame's.
// Twin: reference/lifecycle/lists.hpp.
#if MANAGEMENT == MANAGEMENT_INDEX_LISTS
layout(std430) buffer Survivors { uint survivors[]; };

uint living_list() { return 2u * u_Base + counters[u_Emitter].list * u_Capacity; }
uint next_list() { return 2u * u_Base + (1u - counters[u_Emitter].list) * u_Capacity; }
uint slot_at(uint place) { return survivors[living_list() + place]; }
#else
uint next_list() { return u_Base; }
uint slot_at(uint place) { return place; }
#endif
