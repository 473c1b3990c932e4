// What a particle is born with. Twin: reference/lifecycle/emission.hpp.
#include "turns.glsl"

uniform uint u_Seed; // of the run and the emitter
uniform vec3 u_ShapeLow, u_ShapeSize; // of a sphere its centre; of a point its place
uniform float u_Radius;
uniform vec3 u_Origin, u_LastOrigin;
uniform vec3 u_Direction, u_Side, u_Up; // of the cone: a basis
uniform float u_Jitter, u_Speed, u_SpeedJitter, u_ConeDepth;
uniform vec3 u_Acceleration;
uniform vec2 u_Lifetime, u_Sizes;
uniform vec4 u_Color, u_EndColor;
uniform float u_Time, u_Tick;

vec3 random3(uint serial, uint channel) { return unit3(pcg3d(uvec3(serial, u_Seed, channel))); }

// In [-1, 1).
float symmetric(float u) { return sub(mul(u, 2.0), 1.0); }

vec3 born_at(uint serial, uint k, uint emitted) {
#if SHAPE == SHAPE_POINT
    vec3 p = u_ShapeLow;
#else
    vec3 u = random3(serial, 0u);
#if SHAPE == SHAPE_BOX
    vec3 p = vec3(add(u_ShapeLow.x, mul(u.x, u_ShapeSize.x)), add(u_ShapeLow.y, mul(u.y, u_ShapeSize.y)),
                  add(u_ShapeLow.z, mul(u.z, u_ShapeSize.z)));
#else
    vec3 p = add(u_ShapeLow, mul(on_circle(symmetric(u.x), u.y), u_Radius));
#endif
#endif
#if SPAWN_SPREAD == SPAWN_SPREAD_PATH
    float share = ls_divide(add(float(k), 0.5), float(emitted));
    return add(p, add(u_LastOrigin, mul(sub(u_Origin, u_LastOrigin), share)));
#else
    return add(p, u_Origin);
#endif
}

vec3 born_with(uint serial) {
    vec3 u = random3(serial, 1u);
#if CONE == 1
    vec3 local = on_circle(sub(1.0, mul(u.x, u_ConeDepth)), u.y);
    vec3 direction = add(add(mul(u_Side, local.x), mul(u_Up, local.y)), mul(u_Direction, local.z));
#else
    vec3 direction = vec3(add(u_Direction.x, mul(symmetric(u.x), u_Jitter)),
                          add(u_Direction.y, mul(symmetric(u.y), u_Jitter)),
                          add(u_Direction.z, mul(symmetric(u.z), u_Jitter)));
#endif
    vec3 more = random3(serial, 2u);
    float speed = mul(u_Speed, add(1.0, mul(symmetric(more.x), u_SpeedJitter)));
    return mul(direction, speed);
}

float born_for(uint serial) {
    return add(u_Lifetime.x, mul(random3(serial, 2u).y, sub(u_Lifetime.y, u_Lifetime.x)));
}

// What a particle is born with.
struct Birth {
    vec3 position, velocity, acceleration;
    float lifetime;
    vec2 sizes;
    vec4 color, end_color;
};
#include "emission_graph.glsl"

// Whatever a graph says; of NaN the shortest.
float within_lifetimes(float life) {
    life = life > u_Lifetime.x ? life : u_Lifetime.x;
    return life > u_Lifetime.y ? u_Lifetime.y : life;
}

void set_time_of_birth(float life, uint k) {
#if FLOATS
    set_word(AT_LIFETIME, life);
    set_word(AT_REMAINING, life);
    set_word(AT_SPAWN, u_Time);
#if LAYOUT == LAYOUT_112
    w[22] = k;
#endif
#elif TICKS
    float ticks = floor(add(ls_divide(life, u_Tick), 0.5));
    uint count = ticks > 0.0 ? (ticks < 65535.0 ? uint(ticks) : 65535u) : 0u;
    w[3] = (count << 16) | count;
    set_low(5u, u_Frame & 0xffffu);
#else
    w[3] = (half_of(life, 9u) << 16) | half_of(life, 10u);
    set_low(5u, half_of(u_Time, 11u));
#endif
}

// Particle k of this frame's `emitted`, in `slot`.
void be_born(uint slot, uint k, uint emitted) {
    uint serial = counters[u_Emitter].serial + k;
    for (uint i = 0u; i < STRIDE; ++i)
        w[i] = 0u;
    dither_slot = slot;
    Birth b;
    b.position = born_at(serial, k, emitted);
    b.velocity = born_with(serial);
    b.acceleration = u_Acceleration;
    b.lifetime = born_for(serial);
    b.sizes = u_Sizes;
    b.color = u_Color;
    b.end_color = u_EndColor;
    graph_birth(b, serial, k, emitted);
    set_position(b.position);
    set_velocity(b.velocity);
    set_acceleration(b.acceleration);
    set_time_of_birth(within_lifetimes(b.lifetime), k);
    set_sizes(b.sizes);
    set_colors(b.color, b.end_color);
}
