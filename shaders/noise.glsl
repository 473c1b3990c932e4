// Gradient noise (Perlin, "Improving noise", 2002) with its analytic derivatives, and the curl of three (Bridson,
// "Curl-noise for procedural fluid flow", 2007). Twin: reference/system/noise.hpp.
#ifndef NOISE_GLSL
#define NOISE_GLSL

// One of the 16 edge directions, by 4 bits.
vec3 edge_of(uint h) {
    vec3 g = vec3(0.0);
    float first = (h & 1u) == 0u ? 1.0 : -1.0;
    float second = (h & 2u) == 0u ? 1.0 : -1.0;
    if (h < 8u)
        g.x = first;
    else
        g.y = first;
    if (h < 4u)
        g.y = second;
    else if (h == 12u || h == 14u)
        g.x = second;
    else
        g.z = second;
    return g;
}

float lerp(float a, float b, float t) { return add(a, mul(sub(b, a), t)); }
float trilerp(float c[8], vec3 t) {
    float y0 = lerp(lerp(c[0], c[1], t.x), lerp(c[2], c[3], t.x), t.y);
    float y1 = lerp(lerp(c[4], c[5], t.x), lerp(c[6], c[7], t.x), t.y);
    return lerp(y0, y1, t.z);
}

bool in_noise(vec3 x) { return abs(x.x) < 4194304.0 && abs(x.y) < 4194304.0 && abs(x.z) < 4194304.0; }

struct Cell {
    uvec3 hash[8]; // of the corners, x first
    vec3 at;       // in the cell
};

Cell cell_of(vec3 x, uint seed) {
    vec3 corner = floor(x);
    uvec3 i = uvec3(ivec3(corner));
    Cell cell;
    cell.at = sub(x, corner);
    for (uint k = 0u; k < 8u; ++k)
        cell.hash[k] = pcg3d(uvec3(i.x + (k & 1u), i.y + ((k >> 1) & 1u), (i.z + (k >> 2)) ^ seed)) >> 28;
    return cell;
}

float fade(float w) { return mul(mul(mul(w, w), w), add(mul(w, sub(mul(w, 6.0), 15.0)), 10.0)); }
float fade_slope(float w) { return mul(mul(mul(w, w), 30.0), add(mul(w, sub(w, 2.0)), 1.0)); }

float corner_value(vec3 g, vec3 at, uint k) {
    vec3 d = vec3(sub(at.x, float(k & 1u)), sub(at.y, float((k >> 1) & 1u)), sub(at.z, float(k >> 2)));
    return add(add(mul(g.x, d.x), mul(g.y, d.y)), mul(g.z, d.z));
}

// psi_1, psi_2 or psi_3, and its gradient.
vec4 noise_of(Cell cell, int which) {
    float value[8], gx[8], gy[8], gz[8];
    for (uint k = 0u; k < 8u; ++k) {
        vec3 g = edge_of(cell.hash[k][which]);
        value[k] = corner_value(g, cell.at, k);
        gx[k] = g.x;
        gy[k] = g.y;
        gz[k] = g.z;
    }
    vec3 u = vec3(fade(cell.at.x), fade(cell.at.y), fade(cell.at.z));
    float dx = lerp(lerp(sub(value[1], value[0]), sub(value[3], value[2]), u.y),
                    lerp(sub(value[5], value[4]), sub(value[7], value[6]), u.y), u.z);
    float dy = lerp(lerp(sub(value[2], value[0]), sub(value[3], value[1]), u.x),
                    lerp(sub(value[6], value[4]), sub(value[7], value[5]), u.x), u.z);
    float dz = lerp(lerp(sub(value[4], value[0]), sub(value[5], value[1]), u.x),
                    lerp(sub(value[6], value[2]), sub(value[7], value[3]), u.x), u.y);
    return vec4(add(trilerp(gx, u), mul(fade_slope(cell.at.x), dx)), add(trilerp(gy, u), mul(fade_slope(cell.at.y), dy)),
                add(trilerp(gz, u), mul(fade_slope(cell.at.z), dz)), trilerp(value, u));
}

vec3 all_noise(vec3 x, uint seed) {
    Cell cell = cell_of(x, seed);
    return vec3(noise_of(cell, 0).w, noise_of(cell, 1).w, noise_of(cell, 2).w);
}

#if CURL_DERIVATIVE == CURL_DERIVATIVE_ANALYTIC
vec3 curl(vec3 x, uint seed) {
    Cell cell = cell_of(x, seed);
    vec3 d1 = noise_of(cell, 0).xyz, d2 = noise_of(cell, 1).xyz, d3 = noise_of(cell, 2).xyz;
    return vec3(sub(d3.y, d2.z), sub(d1.z, d3.x), sub(d2.x, d1.y));
}
#else
vec3 slope(vec3 x, vec3 h, uint seed) { return mul(sub(all_noise(add(x, h), seed), all_noise(sub(x, h), seed)), 32.0); }
vec3 curl(vec3 x, uint seed) {
    vec3 by_x = slope(x, vec3(0.015625, 0.0, 0.0), seed);
    vec3 by_y = slope(x, vec3(0.0, 0.015625, 0.0), seed);
    vec3 by_z = slope(x, vec3(0.0, 0.0, 0.015625), seed);
    return vec3(sub(by_y.z, by_z.y), sub(by_z.x, by_x.z), sub(by_x.y, by_y.x));
}
#endif
#endif
