// The numbers that look random: the published hash by a sine, or PCG on integers. Twin: reference/dust/random.hpp.

const uint stream_position = 0u; // x, then y and z
const uint stream_colour = 3u;
const uint stream_chance = 4u;
const uint stream_angle = 5u;
const uint stream_radius = 6u;

uniform uint seed;

uint pcg(uint x) {
    uint s = x * 747796405u + 2891336453u;
    uint y = ((s >> ((s >> 28) + 4u)) ^ s) * 277803737u;
    return (y >> 22) ^ y;
}

uint integer_random(uint item, uint stream, uint frame) { return pcg(item + pcg(stream + pcg(frame + pcg(seed)))); }

// In [0, 1).
float unit(uint bits) { return mul(float(bits >> 8), 1.0 / 16777216.0); }

float even_part(float z) {
    float p = add(mul(z, 2.443315711809948e-5), -1.388731625493765e-3);
    p = add(mul(p, z), 4.166664568298827e-2);
    p = mul(p, z);
    p = mul(p, z);
    p = sub(p, mul(z, 0.5));
    return add(p, 1.0);
}

float odd_part(float z, float rest) {
    float q = add(mul(z, -1.9515295891e-4), 8.3321608736e-3);
    q = add(mul(q, z), -1.6666654611e-1);
    q = mul(q, z);
    return add(mul(q, rest), rest);
}

// Cody and Waite's reduction to an eighth of a turn, then a polynomial; each operation rounded.
float signed_part(float x, int quarter, bool negative) {
    float size = abs(x);
    int j = (int(mul(size, 1.27323954473516)) + 1) & ~1;
    float f = float(j);
    float rest = add(mul(f, -0.78515625), size);
    rest = add(mul(f, -2.4187564849853515625e-4), rest);
    rest = add(mul(f, -3.77489497744594108e-8), rest);
    float z = mul(rest, rest);
    int quadrant = (j / 2 + quarter) & 3;
    float part = (quadrant & 1) != 0 ? even_part(z) : odd_part(z, rest);
    return ((quadrant & 2) != 0) != negative ? neg(part) : part;
}

float portable_sine(float x) {
#if RANDOM == RANDOM_SIN
    precise float s = sin(x);
    return s;
#else
    return signed_part(x, 0, x < 0.0);
#endif
}

float portable_cosine(float x) {
#if RANDOM == RANDOM_SIN
    precise float c = cos(x);
    return c;
#else
    return signed_part(x, 1, false);
#endif
}

float hashed(float argument) {
    float a = mul(portable_sine(argument), 39482.17593);
    return sub(a, floor(a));
}

const float rd1 = 7.8671, rd2 = 3.3419, rp1 = 2.1759, rp2 = 4.7921;

float r11(float s) { return hashed(add(mul(s, rd1), mul(s, rd2))); }
float r21(vec2 s) { return hashed(add(mul(s.x, rd1), mul(s.y, rd2))); }
float second(float s) { return r11(add(s, rp1)); }
float third(float s) { return r11(add(s, rp2)); }
float h1(float x, float y) { return hashed(add(mul(x, 73.867), mul(y, 25.241))); }
