// Sine and cosine of turns, of rounded operations alone. Twin: reference/system/turns.hpp.
#ifndef TURNS_GLSL
#define TURNS_GLSL

vec2 sine_cosine(float x) {
    float r = sub(x, floor(add(x, 0.5)));
    float q = floor(add(mul(r, 4.0), 0.5));
    float f = sub(r, mul(q, 0.25));
    float z = mul(f, f);
    float s = add(mul(z, 42.0586929), -76.7058563);
    s = add(mul(s, z), 81.6052475);
    s = add(mul(s, z), -41.3417015);
    s = add(mul(s, z), 6.28318548);
    s = mul(f, s);
    float c = add(mul(z, 60.2446404), -85.4568176);
    c = add(mul(c, z), 64.9393921);
    c = add(mul(c, z), -19.7392082);
    c = add(mul(c, z), 1.0);
    int quadrant = int(q) & 3;
    vec2 even = quadrant == 0 ? vec2(s, c) : vec2(ls_flush(-s), ls_flush(-c));
    vec2 odd = quadrant == 1 ? vec2(c, ls_flush(-s)) : vec2(ls_flush(-c), s);
    return (quadrant & 1) == 0 ? even : odd;
}

// On the unit sphere: z, and around it.
vec3 on_circle(float z, float turns) {
    float r = ls_sqrt(sub(1.0, mul(z, z)));
    vec2 sc = sine_cosine(turns);
    return vec3(mul(r, sc.y), mul(r, sc.x), z);
}
#endif
