#version 430 core
// How far each point of a ribbon is from the one before. Twin: reference/lifecycle/ribbon_twin.hpp.

#include "lifecycle.glsl"
#include "particles.glsl"
#include "points.glsl"

layout(local_size_x = 256) in;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= counters[u_Emitter].alive)
        return;
    uint slot = point_slot(i);
    float way = 0.0;
    if (i > 0u) {
        load(point_slot(i - 1u));
        vec3 last = position();
        load(slot);
        way = ls_length(sub(position(), last));
    } else {
        load(slot);
    }
    dither_slot = slot;
    set_distance_from_previous(way);
    store(slot);
}
