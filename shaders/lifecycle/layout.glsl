// A particle as words, in each of the seven layouts. Twin: reference/lifecycle/particle.hpp.
#include "random.glsl"
#include "packing.glsl"

#if LAYOUT == LAYOUT_112
#define STRIDE 28u
#elif LAYOUT == LAYOUT_80
#define STRIDE 20u
#elif LAYOUT == LAYOUT_72
#define STRIDE 18u
#elif LAYOUT == LAYOUT_64
#define STRIDE 16u
#elif LAYOUT == LAYOUT_48
#define STRIDE 12u
#elif LAYOUT == LAYOUT_44
#define STRIDE 11u
#else
#define STRIDE 10u
#endif

// Position, Velocity, Acceleration, the lifetimes and SpawnTime are floats, or halves.
#define FLOATS (LAYOUT == LAYOUT_112 || LAYOUT == LAYOUT_80 || LAYOUT == LAYOUT_72)
#define TICKS (!FLOATS && TIME_CODE == TIME_CODE_TICKS16)
#define BOXED (!FLOATS && POSITION_CODE == POSITION_CODE_BOX16)

#if LAYOUT == LAYOUT_112
#define AT_POSITION 0u
#define AT_VELOCITY 4u
#define AT_LIFETIME 7u
#define AT_ACCELERATION 8u
#define AT_REMAINING 15u
#define AT_SPAWN 21u
#define AT_SIZE 3u
#define AT_END_SIZE 19u
#define AT_PREVIOUS 23u
#define AT_START 24u
#else
#define AT_POSITION 0u
#define AT_VELOCITY 3u
#define AT_LIFETIME 6u
#define AT_REMAINING 7u
#define AT_ACCELERATION 8u
#define AT_SPAWN 11u
#if FLOATS
#define AT_SIZE 12u
#define AT_END_SIZE 13u
#define AT_PREVIOUS 14u
#define AT_START 15u
#define AT_COLOR 16u
#elif LAYOUT == LAYOUT_64 || LAYOUT == LAYOUT_48
#define AT_SIZE 6u
#define AT_END_SIZE 7u
#define AT_PREVIOUS 8u
#define AT_START 9u
#define AT_COLOR 10u
#elif LAYOUT == LAYOUT_44
#define AT_SIZES 6u
#define AT_PREVIOUS 7u
#define AT_START 8u
#define AT_COLOR 9u
#else
#define AT_SIZES 6u
#define AT_DISTANCES 7u
#define AT_COLOR 8u
#endif
#endif

uint w[STRIDE]; // the particle at hand

void set_word(uint at, float x) { w[at] = floatBitsToUint(x); }
void set_words(uint at, vec3 v) {
    set_word(at, v.x);
    set_word(at + 1u, v.y);
    set_word(at + 2u, v.z);
}
float word(uint at) { return ls_flush(uintBitsToFloat(w[at])); }
vec3 words(uint at) { return vec3(word(at), word(at + 1u), word(at + 2u)); }

uint high(uint at) { return w[at] >> 16; }
uint low(uint at) { return w[at] & 0xffffu; }
void set_high(uint at, uint code) { w[at] = (code << 16) | (w[at] & 0xffffu); }
void set_low(uint at, uint code) { w[at] = (w[at] & 0xffff0000u) | code; }

// What dithering is keyed by: the slot at hand, the frame, and the field.
uint dither_slot;
uniform uint u_Frame;
uint half_of(float x, uint field) {
#if HALF_ROUNDING == HALF_ROUNDING_DITHERED
    return half_code(x, pcg3d(uvec3(dither_slot, u_Frame, field)).x);
#else
    return half_code(x, 0u);
#endif
}
float value_of(uint code) { return ls_flush(half_value(code)); }

#if BOXED
uniform vec3 u_BoxLow, u_BoxScale, u_BoxStep;

bool box_clamped;
uint box_code(float x, int axis) {
    float code = floor(add(mul(sub(x, u_BoxLow[axis]), u_BoxScale[axis]), 0.5));
    if (!(code >= 0.0 && code <= 65535.0))
        box_clamped = true;
    return code > 0.0 ? (code < 65535.0 ? uint(code) : 65535u) : 0u;
}
float box_value(uint code, int axis) { return add(u_BoxLow[axis], mul(float(code), u_BoxStep[axis])); }
#endif

vec3 position() {
#if FLOATS
    return words(AT_POSITION);
#elif BOXED
    return vec3(box_value(high(0u), 0), box_value(low(0u), 1), box_value(high(1u), 2));
#else
    return vec3(value_of(high(0u)), value_of(low(0u)), value_of(high(1u)));
#endif
}
void set_position(vec3 p) {
#if FLOATS
    set_words(AT_POSITION, p);
#elif BOXED
    box_clamped = false;
    w[0] = (box_code(p.x, 0) << 16) | box_code(p.y, 1);
    set_high(1u, box_code(p.z, 2));
#ifndef DRAWS // a vertex stage counts nothing
    if (box_clamped)
        atomicAdd(counters[u_Emitter].clamped, 1u);
#endif
#else
    w[0] = (half_of(p.x, 0u) << 16) | half_of(p.y, 1u);
    set_high(1u, half_of(p.z, 2u));
#endif
}

vec3 velocity() {
#if FLOATS
    return words(AT_VELOCITY);
#else
    return vec3(value_of(low(1u)), value_of(high(2u)), value_of(low(2u)));
#endif
}
void set_velocity(vec3 v) {
#if FLOATS
    set_words(AT_VELOCITY, v);
#else
    set_low(1u, half_of(v.x, 3u));
    w[2] = (half_of(v.y, 4u) << 16) | half_of(v.z, 5u);
#endif
}

vec3 acceleration() {
#if FLOATS
    return words(AT_ACCELERATION);
#else
    return vec3(value_of(high(4u)), value_of(low(4u)), value_of(high(5u)));
#endif
}
void set_acceleration(vec3 a) {
#if FLOATS
    set_words(AT_ACCELERATION, a);
#else
    w[4] = (half_of(a.x, 6u) << 16) | half_of(a.y, 7u);
    set_high(5u, half_of(a.z, 8u));
#endif
}

// Lifetimes: seconds, or ticks as they are counted.
float lifetime() {
#if FLOATS
    return word(AT_LIFETIME);
#elif TICKS
    return float(high(3u));
#else
    return value_of(high(3u));
#endif
}
float remaining() {
#if FLOATS
    return word(AT_REMAINING);
#elif TICKS
    return float(low(3u));
#else
    return value_of(low(3u));
#endif
}
float spawn_time() {
#if FLOATS
    return word(AT_SPAWN);
#elif TICKS
    return float(low(5u)); // the frame's low 16 bits
#else
    return value_of(low(5u));
#endif
}
void set_remaining(float x) {
#if FLOATS
    set_word(AT_REMAINING, x);
#elif TICKS
    set_low(3u, uint(x));
#else
    set_low(3u, half_of(x, 10u));
#endif
}

float distance_from_previous() {
#if LAYOUT == LAYOUT_40
    return value_of(high(AT_DISTANCES));
#else
    return word(AT_PREVIOUS);
#endif
}
void set_distance_from_previous(float x) {
#if LAYOUT == LAYOUT_40
    set_high(AT_DISTANCES, half_of(x, 14u));
#else
    set_word(AT_PREVIOUS, x);
#endif
}
float distance_from_start() {
#if LAYOUT == LAYOUT_40
    return value_of(low(AT_DISTANCES));
#else
    return word(AT_START);
#endif
}
void set_distance_from_start(float x) {
#if LAYOUT == LAYOUT_40
    set_low(AT_DISTANCES, half_of(x, 15u));
#else
    set_word(AT_START, x);
#endif
}

vec2 sizes() {
#if LAYOUT == LAYOUT_44 || LAYOUT == LAYOUT_40
    return vec2(value_of(high(AT_SIZES)), value_of(low(AT_SIZES)));
#else
    return vec2(word(AT_SIZE), word(AT_END_SIZE));
#endif
}
void set_sizes(vec2 s) {
#if LAYOUT == LAYOUT_44 || LAYOUT == LAYOUT_40
    w[AT_SIZES] = (half_of(s.x, 12u) << 16) | half_of(s.y, 13u);
#else
    set_word(AT_SIZE, s.x);
    set_word(AT_END_SIZE, s.y);
#endif
}

vec4 initial_color() {
#if LAYOUT == LAYOUT_112
    return vec4(words(12u), word(11u));
#else
    return color_value(w[AT_COLOR]);
#endif
}
vec4 end_color() {
#if LAYOUT == LAYOUT_112
    return vec4(words(16u), word(20u));
#else
    return color_value(w[AT_COLOR + 1u]);
#endif
}
void set_colors(vec4 first, vec4 end) {
#if LAYOUT == LAYOUT_112
    set_words(12u, first.rgb);
    set_word(11u, first.a);
    set_words(16u, end.rgb);
    set_word(20u, end.a);
#else
    w[AT_COLOR] = color_code(first.rgb, first.a);
    w[AT_COLOR + 1u] = color_code(end.rgb, end.a);
#endif
}
