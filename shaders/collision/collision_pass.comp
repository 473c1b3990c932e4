#version 430 core
#ifdef LOCKSTEP_INT64_ATOMICS
#extension GL_ARB_gpu_shader_int64 : require
#extension GL_NV_shader_atomic_int64 : require
#define NEAREST_IN_ONE_PASS
#endif
// The collision pass (thesis, Fig. 3-3) as a compute shader (switch step = compute), one invocation a particle: projects
// it to a texel of the collision detection texture, finds the nearest stored position round that texel, answers, or lets
// gravity move it, and offers it to its texel of the next frame's texture. Line numbers are the listing's. The switches
// are the scene file's; see docs/switches.md.

#include "arithmetic.glsl"
#include "collision_code.glsl"
#include "base_texel.glsl"
#include "nearest_particle.glsl"
#include "trace.glsl"

layout(local_size_x = 64) in;

struct Particle {
    vec3 position;
    float speed;
    vec3 direction;
    float collide_time;
};

layout(std430, binding = 0) readonly buffer Before { vec4 before[]; }; // two a particle
layout(std430, binding = 1) writeonly buffer After { vec4 after[]; };

uniform uint u_ParticleCount;
uniform mat4 u_ProjView;
uniform sampler2D u_CDTexture;
uniform int u_TexelCollideRange;
uniform float u_CollisionRange;
uniform float u_CollisionTime;
uniform float u_SpeedFactor;
uniform float u_Tick;
uniform vec3 u_Gravity;

#ifdef LOCKSTEP_TRACE
// One particle, by several invocations: invocation i tells of the i-th texel that is looked at.
struct Trace {
    vec4 trace_clip;
    vec4 trace_point_clip;
    vec2 trace_ndc;
    vec2 trace_texture_coordinate;
    vec2 trace_image_position;
    ivec2 trace_base_texel; // -1: outside the image
    int trace_searches;
    vec3 trace_own_position;
    int trace_neighbour_count; // texels looked at
    ivec2 trace_neighbour_texel;
    int trace_neighbour_reached; // 0 skipped unread, 1 read, 2 holds a particle, 3 compared, 4 nearest so far
    vec3 trace_neighbour_position;
    vec3 trace_neighbour_apart;
    float trace_neighbour_distance;
    int trace_hit;
    vec3 trace_away;     // a hit
    vec3 trace_velocity; // none
};
layout(std430, binding = 4) writeonly buffer Traces { Trace traces[]; };
uniform uint u_TracedParticle;
Trace traced;

void start_trace() {
    traced.trace_searches = 0;
    traced.trace_own_position = vec3(0.0);
    traced.trace_neighbour_count = 0;
    traced.trace_neighbour_texel = ivec2(0);
    traced.trace_neighbour_reached = 0;
    traced.trace_neighbour_position = vec3(0.0);
    traced.trace_neighbour_apart = vec3(0.0);
    traced.trace_neighbour_distance = 0.0;
    traced.trace_hit = 0;
    traced.trace_away = vec3(0.0);
    traced.trace_velocity = vec3(0.0);
}
#define START_TRACE() start_trace()
#define TRACE_NEIGHBOUR(place, value) if (uint(traced.trace_neighbour_count) == gl_GlobalInvocationID.x + 1u) place = value
#define PARTICLE u_TracedParticle
#define END_TRACE() traces[gl_GlobalInvocationID.x] = traced
#else
#define START_TRACE()
#define TRACE_NEIGHBOUR(place, value)
#define PARTICLE gl_GlobalInvocationID.x
#define END_TRACE()
#endif

Particle load(uint particle) {
    vec4 first = before[2u * particle], second = before[2u * particle + 1u];
    return Particle(first.xyz, first.w, second.xyz, second.w);
}

void store(uint particle, Particle a) {
    after[2u * particle] = vec4(a.position, a.speed);
    after[2u * particle + 1u] = vec4(a.direction, a.collide_time);
}

// Each operation a rounding of its own: the locals are `precise`, so no product melts into a sum.
float product(float a, float b) {
    precise float result = ls_flush(a) * ls_flush(b);
    return ls_flush(result);
}

vec3 product(vec3 v, float s) {
    precise vec3 result = ls_flush3(v) * ls_flush(s);
    return ls_flush3(result);
}

vec3 sum(vec3 a, vec3 b) {
    precise vec3 result = ls_flush3(a) + ls_flush3(b);
    return ls_flush3(result);
}

bool holds_particle(vec4 stored) {
#if EMPTY_TEXEL == EMPTY_TEXEL_SKIP
    return stored.a != 0.0;
#else
    return true;
#endif
}

bool on_image(ivec2 texel) {
    return texel.x >= 0 && texel.y >= 0 && texel.x < u_ClientWidth && texel.y < u_ClientHeight;
}

// Operations of `exact` are long sequences: who is beyond the range by plain ones needs none. The factor outweighs roundings,
// the least range what is flushed.
bool is_beyond_range(vec3 apart) {
#if ARITHMETIC == ARITHMETIC_EXACT && !defined(LOCKSTEP_TRACE)
    return dot(apart, apart) > max(u_CollisionRange * u_CollisionRange, 1e-24) * 1.00001;
#else
    return false;
#endif
}

// Lines 5 to 19. True when a stored position lies within the collision range; `away` then is own minus nearest.
bool nearest_collision(vec3 position, ivec2 texel_base, out vec3 away) {
    away = vec3(0.0);
    TRACE(traced.trace_searches, 1);
    precise vec3 curr_pos = position;
#if SELF_POSITION == SELF_POSITION_TEXEL
    vec4 stored_self = texelFetch(u_CDTexture, texel_base, 0);
    if (!holds_particle(stored_self))
        return false;
    curr_pos = decode_position(stored_self);
#endif
    TRACE(traced.trace_own_position, curr_pos);
    precise float particle_min_length = 100000.0;
    bool particle_collision = false;
    for (int ty = -u_TexelCollideRange; ty <= u_TexelCollideRange; ++ty) {
        for (int tx = -u_TexelCollideRange; tx <= u_TexelCollideRange; ++tx) {
            ivec2 texel = texel_base + ivec2(tx, ty);
            TRACE(traced.trace_neighbour_count, traced.trace_neighbour_count + 1);
            TRACE_NEIGHBOUR(traced.trace_neighbour_texel, texel);
            if ((tx == 0 && ty == 0) || !on_image(texel))
                continue;
            vec4 stored = texelFetch(u_CDTexture, texel, 0);
            TRACE_NEIGHBOUR(traced.trace_neighbour_reached, 1);
            if (!holds_particle(stored))
                continue;
            if (is_beyond_range(curr_pos - decode_position(stored)))
                continue;
            vec3 apart = sum(curr_pos, -decode_position(stored));
            float len = ls_length(apart);
            TRACE_NEIGHBOUR(traced.trace_neighbour_reached, 2);
            TRACE_NEIGHBOUR(traced.trace_neighbour_position, decode_position(stored));
            TRACE_NEIGHBOUR(traced.trace_neighbour_apart, apart);
            TRACE_NEIGHBOUR(traced.trace_neighbour_distance, len);
#if ZERO_DISTANCE == ZERO_DISTANCE_SKIP
            if (len == 0.0)
                continue;
#endif
            TRACE_NEIGHBOUR(traced.trace_neighbour_reached, 3);
            if (u_CollisionRange > len && len < particle_min_length) {
                particle_min_length = len;
                away = apart;
                particle_collision = true;
                TRACE_NEIGHBOUR(traced.trace_neighbour_reached, 4);
            }
        }
    }
    return particle_collision;
}

// Lines 21 to 24.
Particle collide(Particle a, vec3 away) {
    TRACE(traced.trace_hit, 1);
    TRACE(traced.trace_away, away);
    Particle v;
#if VELOCITY == VELOCITY_VECTOR
    v.direction = product(ls_normalize(away), product(ls_length(a.direction), u_SpeedFactor));
    v.speed = ls_flush(a.speed);
#else
    v.speed = product(a.speed, u_SpeedFactor);
    v.direction = ls_normalize(away);
#endif
    v.collide_time = u_CollisionTime;
    vec3 step = product(v.direction, v.speed);
#if COLLISION_STEP == COLLISION_STEP_TICK
    step = product(step, u_Tick);
#endif
    v.position = sum(a.position, step);
    return v;
}

// Lines 26 to 30.
Particle integrate(Particle a) {
    Particle v;
    vec3 temp = sum(product(a.direction, a.speed), product(u_Gravity, u_Tick));
    TRACE(traced.trace_velocity, temp);
#if VELOCITY == VELOCITY_VECTOR
    v.direction = temp;
    v.speed = ls_flush(a.speed);
#else
    v.direction = ls_normalize(temp);
    v.speed = ls_length(temp);
#endif
    precise float collide_time = ls_flush(a.collide_time) - u_Tick;
    v.collide_time = ls_flush(collide_time);
    v.position = sum(a.position, product(product(v.direction, v.speed), u_Tick));
    return v;
}

// By the listing's indentation, lines 9 to 30 belong to those that search.
Particle stand(Particle a) {
    Particle v;
    v.position = ls_flush3(a.position);
    v.direction = ls_flush3(a.direction);
    v.speed = ls_flush(a.speed);
    v.collide_time = ls_flush(a.collide_time);
    return v;
}

void main() {
    uint self = PARTICLE;
    if (self >= u_ParticleCount)
        return;
    START_TRACE();
    Particle a = load(self);
    ivec2 texel_base;
    vec3 away = vec3(0.0);
    bool visible = base_texel(position_in_texel(ls_transform(u_ProjView, a.position)), texel_base);
    TRACE(traced.trace_clip, last_clip);
    TRACE(traced.trace_ndc, last_ndc);
    TRACE(traced.trace_texture_coordinate, last_texture_coordinate);
    TRACE(traced.trace_image_position, last_image_position);
    TRACE(traced.trace_base_texel, visible ? texel_base : ivec2(-1));
    Particle v;
#if NOT_SEARCHING == NOT_SEARCHING_STANDS
    if (!(0.0 > ls_flush(a.collide_time)))
        v = stand(a);
    else
#endif
    if (ls_flush(a.collide_time) < 0.0 && visible && nearest_collision(a.position, texel_base, away))
        v = collide(a, away);
    else
        v = integrate(a);
    store(self, v);
#if RASTER_POSITION == RASTER_POSITION_UPDATED
    vec4 clip = ls_transform(u_ProjView, v.position);
#else
    vec4 clip = ls_transform(u_ProjView, a.position);
#endif
    TRACE(traced.trace_point_clip, clip);
    offer_to_texel(self, clip);
    END_TRACE();
}
