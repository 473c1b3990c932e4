#version 430 core
// The particle pass of the depth comparator, one invocation a particle: engines hold particles against the scene's depth.
// Looks up the depth that was drawn where the particle is seen, brings it back to the world by the inverse matrix, takes
// the normal from the texels to the right and above, and answers where the particle lies closely behind, or lets gravity
// move it. Particles are not in that image and do not meet. Line numbers are the listing's (thesis, Fig. 3-3).

#include "arithmetic.glsl"
#include "base_texel.glsl"
#include "trace.glsl"

layout(local_size_x = 64) in;

struct Particle {
    vec3 position;
    float speed;
    vec3 direction;
    float collide_time;
};

layout(std430, binding = 0) readonly buffer Before { Particle before[]; };
layout(std430, binding = 1) writeonly buffer After { Particle after[]; };

uniform sampler2D u_Depth; // red: window depth of the nearest obstacle; alpha 0: none
uniform mat4 u_ProjView;   // what it was drawn with
uniform mat4 u_InverseProjView;
uniform float u_SurfaceThickness;
uniform uint u_ParticleCount;
uniform float u_CollisionTime;
uniform float u_SpeedFactor;
uniform float u_Tick;
uniform vec3 u_Gravity;

#ifdef LOCKSTEP_TRACE
// One particle, by several invocations: invocation i tells of the i-th texel whose surface is asked for.
struct Trace {
    int trace_searches;
    vec4 trace_clip;
    int trace_in_front;
    vec2 trace_ndc;
    vec2 trace_texture_coordinate;
    vec2 trace_image_position;
    ivec2 trace_base_texel; // -1: outside the image
    int trace_neighbour_count;
    int trace_neighbour_reached; // 0 outside the image, 1 read, 2 shows a surface
    vec3 trace_neighbour_ndc;
    vec4 trace_neighbour_unprojected;
    vec3 trace_neighbour_surface;
    float trace_neighbour_w;
    float trace_behind;
    int trace_is_behind;
    int trace_is_within;
    vec3 trace_to_right;
    vec3 trace_to_upper;
    vec3 trace_normal;
    int trace_hit;
    vec3 trace_away;     // a hit
    vec3 trace_velocity; // none
};
layout(std430, binding = 4) writeonly buffer Traces { Trace traces[]; };
uniform uint u_TracedParticle;
Trace traced;

void start_trace() {
    traced.trace_searches = 0;
    traced.trace_in_front = 0;
    traced.trace_base_texel = ivec2(-1);
    traced.trace_neighbour_count = 0;
    traced.trace_neighbour_reached = 0;
    traced.trace_is_behind = 0;
    traced.trace_is_within = 0;
    traced.trace_hit = 0;
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

// Each operation a rounding of its own: the locals are `precise`, so no product melts into a sum.
float product(float a, float b) {
    precise float result = ls_flush(a) * ls_flush(b);
    return ls_flush(result);
}

vec3 product(vec3 v, float s) {
    precise vec3 result = ls_flush3(v) * ls_flush(s);
    return ls_flush3(result);
}

float sum(float a, float b) {
    precise float result = ls_flush(a) + ls_flush(b);
    return ls_flush(result);
}

vec3 sum(vec3 a, vec3 b) {
    precise vec3 result = ls_flush3(a) + ls_flush3(b);
    return ls_flush3(result);
}

vec3 cross_product(vec3 a, vec3 b) {
    return vec3(sum(product(a.y, b.z), -product(a.z, b.y)), sum(product(a.z, b.x), -product(a.x, b.z)),
                sum(product(a.x, b.y), -product(a.y, b.x)));
}

// What a texel shows: its place in the world, and how far it lies from the camera, as clip w has it. False outside the
// image, and where no obstacle is drawn.
bool surface(ivec2 texel, out vec3 position, out float distance) {
    position = vec3(0.0);
    distance = 0.0;
    TRACE(traced.trace_neighbour_count, traced.trace_neighbour_count + 1);
    if (texel.x < 0 || texel.y < 0 || texel.x >= u_ClientWidth || texel.y >= u_ClientHeight)
        return false;
    vec4 stored = texelFetch(u_Depth, texel, 0);
    TRACE_NEIGHBOUR(traced.trace_neighbour_reached, 1);
    if (stored.a == 0.0)
        return false;
    float depth = ls_flush(stored.r);
    precise vec3 ndc = vec3(ls_divide(float(texel.x) + 0.5, float(u_ClientWidth)),
                            ls_divide(float(texel.y) + 0.5, float(u_ClientHeight)), depth) * 2.0 - 1.0;
    vec4 p = ls_transform(u_InverseProjView, ndc);
    position = vec3(ls_divide(p.x, p.w), ls_divide(p.y, p.w), ls_divide(p.z, p.w));
    distance = ls_divide(1.0, p.w);
    TRACE_NEIGHBOUR(traced.trace_neighbour_reached, 2);
    TRACE_NEIGHBOUR(traced.trace_neighbour_ndc, ndc);
    TRACE_NEIGHBOUR(traced.trace_neighbour_unprojected, p);
    TRACE_NEIGHBOUR(traced.trace_neighbour_surface, position);
    TRACE_NEIGHBOUR(traced.trace_neighbour_w, distance);
    return true;
}

// True where the particle lies behind a surface by less than its thickness; `normal` then points out of it.
bool surface_hit(vec3 own, out vec3 normal) {
    normal = vec3(0.0);
    vec4 clip = ls_transform(u_ProjView, own);
    TRACE(traced.trace_searches, 1);
    TRACE(traced.trace_clip, clip);
    TRACE(traced.trace_in_front, clip.w > 0.0 ? 1 : 0);
    if (!(clip.w > 0.0))
        return false;
    ivec2 texel;
    bool on_image = base_texel(image_position(clip), texel);
    TRACE(traced.trace_ndc, last_ndc);
    TRACE(traced.trace_texture_coordinate, last_texture_coordinate);
    TRACE(traced.trace_image_position, last_image_position);
    if (!on_image)
        return false;
    TRACE(traced.trace_base_texel, texel);
    vec3 here, right, upper;
    float distance, unused;
    if (!surface(texel, here, distance))
        return false;
    float behind = sum(clip.w, -distance);
    TRACE(traced.trace_behind, behind);
    TRACE(traced.trace_is_behind, behind > 0.0 ? 1 : 0);
    TRACE(traced.trace_is_within, behind < u_SurfaceThickness ? 1 : 0);
    if (!(behind > 0.0) || !(behind < u_SurfaceThickness))
        return false;
    if (!surface(texel + ivec2(1, 0), right, unused) || !surface(texel + ivec2(0, 1), upper, unused))
        return false;
    normal = cross_product(sum(right, -here), sum(upper, -here));
    TRACE(traced.trace_to_right, sum(right, -here));
    TRACE(traced.trace_to_upper, sum(upper, -here));
    TRACE(traced.trace_normal, normal);
    TRACE(traced.trace_hit, 1);
    return true;
}

// Lines 21 to 24.
Particle collide(Particle a, vec3 away) {
    Particle v;
    TRACE(traced.trace_away, away);
    v.speed = product(a.speed, u_SpeedFactor);
    v.direction = ls_normalize(away);
    v.collide_time = u_CollisionTime;
    vec3 moved = product(v.direction, v.speed);
#if COLLISION_STEP == COLLISION_STEP_TICK
    moved = product(moved, u_Tick);
#endif
    v.position = sum(a.position, moved);
    return v;
}

// Lines 26 to 30.
Particle integrate(Particle a) {
    Particle v;
    vec3 temp = sum(product(a.direction, a.speed), product(u_Gravity, u_Tick));
    TRACE(traced.trace_velocity, temp);
    v.direction = ls_normalize(temp);
    v.speed = ls_length(temp);
    v.collide_time = sum(a.collide_time, -u_Tick);
    v.position = sum(a.position, product(product(v.direction, v.speed), u_Tick));
    return v;
}

void main() {
    uint self = PARTICLE;
    if (self >= u_ParticleCount)
        return;
    START_TRACE();
    Particle a = before[self];
    vec3 normal = vec3(0.0);
    if (ls_flush(a.collide_time) < 0.0 && surface_hit(a.position, normal))
        after[self] = collide(a, normal);
    else
        after[self] = integrate(a);
    END_TRACE();
}
