#version 430 core
// How far each point of a ribbon is from the one before. Twin: reference/lifecycle/ribbon_twin.hpp.

#include "lifecycle.glsl"
#include "particles.glsl"

layout(local_size_x = 256) in;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= counters[u_Emitter].alive)
        return;
    float way = 0.0;
    if (i > 0u) {
        load(i - 1u);
        vec3 last = position();
        load(i);
        way = ls_length(sub(position(), last));
    } else {
        load(i);
    }
    dither_slot = i;
    set_distance_from_previous(way);
    store(i);
}
