// Codes of 16 and 8 bits, rounded here by integers: packHalf2x16 and its like leave the rounding to the driver.
// Twin: reference/lifecycle/packing.hpp.

float half_value(uint code) {
    uint magnitude = code & 0x7fffu;
    uint sign = (code & 0x8000u) << 16;
    if (magnitude < 0x400u) {
        float tiny = float(magnitude) * (1.0 / 16777216.0); // exact
        return uintBitsToFloat(magnitude == 0u ? sign : floatBitsToUint(tiny) | sign);
    }
    if (magnitude >= 0x7c00u)
        return uintBitsToFloat(0x7f800000u | ((magnitude & 0x3ffu) << 13) | sign);
    return uintBitsToFloat(((magnitude << 13) + 0x38000000u) | sign);
}

// `dither`: random bits, of which as many as are cut off are added.
uint half_code(float x, uint dither) {
    uint bits = floatBitsToUint(x);
    uint m = bits & 0x7fffffffu;
    uint sign = (bits >> 16) & 0x8000u;
    if (m > 0x7f800000u)
        return 0x7e00u;
    if (m == 0x7f800000u)
        return sign | 0x7c00u;
    uint code;
    if (m >= 0x38800000u) {
        uint t = m - 0x38000000u;
#if HALF_ROUNDING == HALF_ROUNDING_TOWARD_ZERO
        code = t >> 13;
#elif HALF_ROUNDING == HALF_ROUNDING_NEAREST_EVEN
        code = (t + 0xfffu + ((t >> 13) & 1u)) >> 13;
#else
        code = (t + (dither & 0x1fffu)) >> 13;
#endif
        code = min(code, 0x7bffu);
    } else {
        uint e = m >> 23;
#if HALF_ROUNDING == HALF_ROUNDING_DITHERED
        if (e < 103u)
#else
        if (e < 102u)
#endif
            code = 0u;
        else {
            uint g = (m & 0x7fffffu) | 0x800000u;
            uint n = 126u - e;
#if HALF_ROUNDING == HALF_ROUNDING_TOWARD_ZERO
            code = g >> n;
#elif HALF_ROUNDING == HALF_ROUNDING_NEAREST_EVEN
            code = (g + (1u << (n - 1u)) - 1u + ((g >> n) & 1u)) >> n;
#else
            code = (g + (dither & ((1u << n) - 1u))) >> n;
#endif
        }
    }
#if ARITHMETIC == ARITHMETIC_EXACT
    if (code == 0u)
        return 0u;
#endif
    return sign | code;
}

// 0 to 1 in `steps` steps; NaN is 0.
uint unorm_code(float c, float steps) {
    float clamped = c > 0.0 ? (c < 1.0 ? c : 1.0) : 0.0;
    return uint(floor(add(mul(clamped, steps), 0.5)));
}

uint color_code(vec3 color, float opacity) {
#if COLOR_CODE == COLOR_CODE_RGBA8
    return unorm_code(color.r, 255.0) | (unorm_code(color.g, 255.0) << 8) | (unorm_code(color.b, 255.0) << 16) |
           (unorm_code(opacity, 255.0) << 24);
#else
    return unorm_code(color.r, 1023.0) | (unorm_code(color.g, 1023.0) << 10) | (unorm_code(color.b, 1023.0) << 20) |
           (unorm_code(opacity, 3.0) << 30);
#endif
}

vec4 color_value(uint code) {
#if COLOR_CODE == COLOR_CODE_RGBA8
    return vec4(ls_divide(float(code & 255u), 255.0), ls_divide(float((code >> 8) & 255u), 255.0),
                ls_divide(float((code >> 16) & 255u), 255.0), ls_divide(float(code >> 24), 255.0));
#else
    return vec4(ls_divide(float(code & 1023u), 1023.0), ls_divide(float((code >> 10) & 1023u), 1023.0),
                ls_divide(float((code >> 20) & 1023u), 1023.0), ls_divide(float(code >> 30), 3.0));
#endif
}
