// What a texel of the collision detection texture stores, and back to a position. The shader rounds to the stored
// precision itself, so that the driver's own conversion has nothing left to decide. Alpha 0: empty.

uniform vec3 u_CdtBoxMin;   // rgba8: the corner code 0 stands for
uniform vec3 u_CdtBoxStep;  // rgba8: box size / 255
uniform vec3 u_CdtBoxScale; // rgba8: 255 / box size

// To the nearest half, ties to even; below the smallest normal half (2^-14) to zero, above the largest to 65504.
// NaN stays.
float half_round(float x) {
    uint bits = floatBitsToUint(x);
    uint magnitude = bits & 0x7fffffffu;
    uint sign = bits & 0x80000000u;
    if (magnitude < 0x38800000u)
        return 0.0;
    if (magnitude > 0x7f800000u)
        return x;
    uint rounded = (magnitude + 0xfffu + ((magnitude >> 13) & 1u)) & ~0x1fffu;
    return uintBitsToFloat(sign | min(rounded, 0x477fe000u));
}

float unorm8_code(float x, float low, float scale) {
    precise float code = (x - low) * scale;
    return code > 0.0 ? floor(min(code, 255.0) + 0.5) : 0.0; // NaN: 0
}

vec4 encode_position(vec3 p) {
#if CDT_FORMAT == CDT_FORMAT_RGBA8
    precise vec3 code = vec3(unorm8_code(p.x, u_CdtBoxMin.x, u_CdtBoxScale.x),
                             unorm8_code(p.y, u_CdtBoxMin.y, u_CdtBoxScale.y),
                             unorm8_code(p.z, u_CdtBoxMin.z, u_CdtBoxScale.z));
    return vec4(code / 255.0, 1.0);
#elif CDT_FORMAT == CDT_FORMAT_RGBA16F
    return vec4(half_round(p.x), half_round(p.y), half_round(p.z), 1.0);
#else
    return vec4(p, 1.0);
#endif
}

vec3 decode_position(vec4 texel) {
#if CDT_FORMAT == CDT_FORMAT_RGBA8
    precise vec3 code = floor(texel.xyz * 255.0 + 0.5);
    precise vec3 p = u_CdtBoxMin + code * u_CdtBoxStep;
    return p;
#else
    return texel.xyz;
#endif
}
