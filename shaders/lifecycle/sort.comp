#version 430 core
// A step of the bitonic network: compares keys that are u_Apart from each other, in runs of u_Run that rise and fall in
// turn. Twin: reference/lifecycle/sort_twin.hpp.

#include "keys.glsl"

layout(local_size_x = 256) in;

uniform uint u_Run, u_Apart;

bool before(Key a, Key b) {
    return a.time != b.time ? a.time < b.time : a.order != b.order ? a.order < b.order : a.of < b.of;
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= u_Keys / 2u)
        return;
    uint low = ((i & ~(u_Apart - 1u)) << 1) | (i & (u_Apart - 1u));
    Key first = keys[u_FirstKey + low], second = keys[u_FirstKey + low + u_Apart];
    bool rises = (low & u_Run) == 0u;
    if (before(second, first) == rises) {
        keys[u_FirstKey + low] = second;
        keys[u_FirstKey + low + u_Apart] = first;
    }
}
