// Arithmetic with the same bits on every conforming driver. Twin: reference/portable.hpp.
//
// Tiny values. A magnitude of 2^-126 (the smallest normal float) or less is *tiny* and counts as +0, as an operand and
// as a result, so it does not matter whether a driver flushes subnormals. 2^-126 itself is in, because a product just
// below it rounds up to it or is flushed, depending on the driver. Zero has no sign: no function returns -0, and
// x / -0 is x / +0.
//
// What a pass has to do. Operands of its own +, - and * are not tiny: attributes, uniforms and texels go through
// ls_flush when they are read, and so does each sum, difference and product when it is made, into a `precise` variable
// (which holds within one function only). The ls_ functions take any bits and return no tiny value.
//
// Division and square root start from a guess in float arithmetic, at most 2 units off in the last place, and are then
// set right by the exact integer remainder; that remainder is small, so its low 32 bits are all of it. Neither has
// ties: a halfway quotient or root has one bit more than its operands allow. Checked for every significand.
//
// Infinity and NaN as in IEEE 754; NaN is the one with bits 0x7fc00000.

const int ls_magnitude = 0x7fffffff;
const int ls_fraction = 0x007fffff;
const int ls_leading_one = 0x00800000;
const int ls_smallest = 0x00800000; // 2^-126
const int ls_infinity = 0x7f800000;
const int ls_nan = 0x7fc00000;
const int ls_one = 0x3f800000;

float ls_flush(float x) {
    int bits = floatBitsToInt(x);
    return intBitsToFloat((bits & ls_magnitude) > ls_smallest ? bits : 0);
}

vec3 ls_flush3(vec3 v) { return vec3(ls_flush(v.x), ls_flush(v.y), ls_flush(v.z)); }

// Correctly rounded. a / 0 is infinite with the sign of a; 0 / 0 and inf / inf are NaN.
float ls_divide(float a, float b) {
    int bits_a = floatBitsToInt(ls_flush(a));
    int bits_b = floatBitsToInt(ls_flush(b));
    int sign = (bits_a ^ bits_b) & ~ls_magnitude;
    int x = bits_a & ls_magnitude;
    int y = bits_b & ls_magnitude;

    int n = (x & ls_fraction) | ls_leading_one;
    int d = (y & ls_fraction) | ls_leading_one;
    int doubled = int(n < d); // so that n / d is in [1, 2)
    n <<= doubled;

    // 1 / m for m = d / 2^23: a quadratic within 1/99 (1 - m p(m) is a Chebyshev polynomial), two Newton steps.
    precise float m = intBitsToFloat((y & ls_fraction) | ls_one);
    precise float r = (0.323232323 * m - 1.454545455) * m + 2.121212121;
    r = r + r * (1.0 - m * r);
    r = r + r * (1.0 - m * r);
    precise float guess = float(n) * r;

    int q = int(guess);
    int twice_rest = 2 * ((n << 23) - q * d);
    q += int(twice_rest > d) + int(twice_rest > 3 * d) - int(twice_rest < -d) - int(twice_rest < -3 * d);

    int exponent = min((x >> 23) - (y >> 23) - doubled + 127, 255);
    int quotient = min(((exponent - 1) << 23) + q, ls_infinity);
    quotient = x == 0 || y == ls_infinity || quotient <= ls_smallest ? 0 : quotient | sign;
    quotient = x == ls_infinity || y == 0 ? ls_infinity | sign : quotient;
    bool invalid = x > ls_infinity || y > ls_infinity || (x == y && (x == 0 || x == ls_infinity));
    return intBitsToFloat(invalid ? ls_nan : quotient);
}

// Correctly rounded.
float ls_reciprocal(float a) { return ls_divide(1.0, a); }

// Correctly rounded. The root of a negative number is NaN, that of -0 is +0.
float ls_sqrt(float a) {
    int bits = floatBitsToInt(ls_flush(a));
    int odd = ~(bits >> 23) & 1; // the exponent, without its bias of 127
    int n = ((bits & ls_fraction) | ls_leading_one) << odd;

    // 1 / sqrt(m) for m = n / 2^23: a minimax quadratic on [1, 2), within 1/313, two Newton steps.
    precise float m = intBitsToFloat((bits & ls_fraction) | ls_one);
    precise float r = (0.147687586 * m - 0.730514325) * m + 1.579639094;
    precise float half_m = odd == 1 ? m : 0.5 * m;
    r = odd == 1 ? r * 0.707106781 : r;
    r = r + r * (0.5 - (half_m * r) * r);
    r = r + r * (0.5 - (half_m * r) * r);
    precise float guess = float(n) * r;

    int s = int(guess);
    int rest = (n << 23) - s * s;
    s += int(rest > s) + int(rest > 3 * s + 2) - int(rest <= -s) - int(rest <= 2 - 3 * s);

    int root = (((bits >> 23) - odd + 125) >> 1 << 23) + s;
    root = bits == 0 || bits == ls_infinity ? bits : root;
    return intBitsToFloat(bits < 0 || bits > ls_infinity ? ls_nan : root);
}

// Two roundings: within 1.5 ULP.
float ls_inverse_sqrt(float a) { return ls_divide(1.0, ls_sqrt(a)); }

// a * b, correctly rounded.
float ls_multiply(float a, float b) {
    precise float product = ls_flush(a) * ls_flush(b);
    return ls_flush(product);
}

// a + b of operands that are not tiny, correctly rounded.
float ls_add(float a, float b) {
    precise float sum = a + b;
    return ls_flush(sum);
}

// Left to right: (x + y) + z, each operation correctly rounded.
float ls_dot(vec3 a, vec3 b) {
    return ls_add(ls_add(ls_multiply(a.x, b.x), ls_multiply(a.y, b.y)), ls_multiply(a.z, b.z));
}

// The root of ls_dot(v, v): within 2 ULP for lengths from 2^-48, under which squares are lost as tiny, to 2^63.
float ls_length(vec3 v) { return ls_sqrt(ls_dot(v, v)); }

// v * (1 / length): within 4 ULP a component for the same lengths. All NaN where the length is 0, infinite or NaN.
vec3 ls_normalize(vec3 v) {
    float squared = ls_dot(v, v);
    int bits = floatBitsToInt(squared);
    if (bits == 0 || bits >= ls_infinity) return vec3(intBitsToFloat(ls_nan));
    float s = ls_inverse_sqrt(squared);
    return vec3(ls_multiply(v.x, s), ls_multiply(v.y, s), ls_multiply(v.z, s));
}

// m * vec4(v, 1), columns left to right: ((x + y) + z) + w.
vec4 ls_transform(mat4 m, vec3 v) {
    vec4 product;
    for (int row = 0; row < 4; ++row) {
        float xy = ls_add(ls_multiply(m[0][row], v.x), ls_multiply(m[1][row], v.y));
        product[row] = ls_add(ls_add(xy, ls_multiply(m[2][row], v.z)), ls_flush(m[3][row]));
    }
    return product;
}
