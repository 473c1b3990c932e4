// Finds the particle nearest to the collision camera in every texel, by integer atomics: of equally near ones that of the
// lowest index. The least pair of depth and index is the same in whatever order the particles come. A depth of 0 to 1 is
// ordered like its bits.
//
// A pass calls offer_to_texel() once for each particle. With 64-bit atomics (NEAREST_IN_ONE_PASS, which a stage defines
// that has them) the pair is one number. Otherwise the least depth of a texel is found here, and its lowest index by
// nearest_particle.comp. Needs arithmetic.glsl and base_texel.glsl.

#ifdef NEAREST_IN_ONE_PASS
layout(std430, binding = 2) buffer Nearest { uint64_t nearest[]; }; // a texel each: depth above, particle below
#else
layout(std430, binding = 2) buffer Nearest { uint nearest[]; }; // two a texel: particle, depth
layout(std430, binding = 3) writeonly buffer Offers { uvec2 offers[]; }; // one a particle: texel, depth
#endif

const uint nowhere = 0xffffffffu;

// The texel that the next frame will compute for a particle, and its window depth. False where it is not drawn.
bool placed_point(vec4 clip, out ivec2 texel, out float depth) {
    bool visible = base_texel(position_in_texel(clip), texel);
    precise float window = (ls_divide(clip.z, clip.w) + 1.0) * 0.5;
#if ARITHMETIC == ARITHMETIC_EXACT
    precise float on_grid = floor(window * 16777216.0) * (1.0 / 16777216.0);
    depth = on_grid;
#else
    depth = window;
#endif
    return visible && clip.w > 0.0 && window >= 0.0 && window <= 1.0;
}

void offer_to_texel(uint particle, vec4 clip) {
    ivec2 at;
    float depth;
    bool drawn = placed_point(clip, at, depth);
    uint texel = uint(at.y * u_ClientWidth + at.x);
#ifdef NEAREST_IN_ONE_PASS
    if (drawn)
        atomicMin(nearest[texel], packUint2x32(uvec2(particle, floatBitsToUint(depth))));
#else
    offers[particle] = uvec2(drawn ? texel : nowhere, floatBitsToUint(depth));
    if (drawn)
        atomicMin(nearest[2u * texel + 1u], floatBitsToUint(depth));
#endif
}
