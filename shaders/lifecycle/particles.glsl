// Both copies of the particles: what the pass before left, and what this one makes. Words, for in a struct std430 would
// align a vec3.
#include "layout.glsl"

layout(std430) readonly buffer ParticlesBefore { uint before[]; };
layout(std430) buffer ParticlesAfter { uint after[]; };

void load(uint slot) {
    for (uint k = 0u; k < STRIDE; ++k)
        w[k] = before[(u_Base + slot) * STRIDE + k];
}
void store(uint slot) {
    for (uint k = 0u; k < STRIDE; ++k)
        after[(u_Base + slot) * STRIDE + k] = w[k];
}
