// To the nearest half, ties to even; below the smallest normal half (2^-14) to zero, above the largest to 65504.
// NaN stays. Twin: reference/half.hpp.
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

vec4 half_round(vec4 v) { return vec4(half_round(v.x), half_round(v.y), half_round(v.z), half_round(v.w)); }
