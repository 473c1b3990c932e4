// The points of a ribbon, oldest first. Twin: reference/lifecycle/sort_twin.hpp.
#if MANAGEMENT == MANAGEMENT_INDEX_LISTS
#include "keys.glsl"

uint point_slot(uint place) { return keys[u_FirstKey + place].of; }
#else
uint point_slot(uint place) { return place; }
#endif
