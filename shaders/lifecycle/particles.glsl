// Both copies of the particles: what the pass before left, and what this one makes. Words, for in a struct std430 would
// align a vec3; two at a time where a particle has an even number of them, which a GPU writes in half as many pieces.
#include "layout.glsl"

#if LAYOUT == LAYOUT_44
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
#else
#define PAIRS (STRIDE / 2u)
layout(std430) readonly buffer ParticlesBefore { uvec2 before[]; };
layout(std430) buffer ParticlesAfter { uvec2 after[]; };

void load(uint slot) {
    for (uint k = 0u; k < PAIRS; ++k) {
        uvec2 two = before[(u_Base + slot) * PAIRS + k];
        w[2u * k] = two.x;
        w[2u * k + 1u] = two.y;
    }
}
void store(uint slot) {
    for (uint k = 0u; k < PAIRS; ++k)
        after[(u_Base + slot) * PAIRS + k] = uvec2(w[2u * k], w[2u * k + 1u]);
}
#endif
