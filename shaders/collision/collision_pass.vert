#version 330 core
#extension GL_ARB_gpu_shader5 : require
// The collision pass (thesis, Fig. 3-3), one vertex a particle: projects it to a texel of the collision detection
// texture, finds the nearest stored position round that texel, and answers, or lets gravity move it.
// Line numbers are the listing's. The switches are the scene file's; see docs/switches.md.

#include "arithmetic.glsl"
#include "collision_code.glsl"
#include "base_texel.glsl"
#include "trace.glsl"

in vec3 a_Position;
in vec3 a_Dir;
in float a_Speed;
in float a_CollideTime;

uniform mat4 u_ProjView;
uniform sampler2D u_CDTexture;
uniform int u_TexelCollideRange;
uniform float u_CollisionRange;
uniform float u_CollisionTime;
uniform float u_SpeedFactor;
uniform float u_Tick;
uniform vec3 u_Gravity;

precise out vec3 v_Position;
precise out vec3 v_Dir;
precise out float v_Speed;
precise out float v_CollideTime;
precise gl_Position;

#ifdef LOCKSTEP_TRACE
// Drawn as several instances of one particle: instance i tells of the i-th texel that is looked at.
out vec4 trace_clip;
out vec2 trace_ndc;
out vec2 trace_texture_coordinate;
out vec2 trace_image_position;
flat out ivec2 trace_base_texel; // -1: outside the image
flat out int trace_searches;
out vec3 trace_own_position;
flat out int trace_neighbour_count; // texels looked at
flat out ivec2 trace_neighbour_texel;
flat out int trace_neighbour_reached; // 0 skipped unread, 1 read, 2 holds a particle, 3 compared, 4 nearest so far
out vec3 trace_neighbour_position;
out vec3 trace_neighbour_apart;
out float trace_neighbour_distance;
flat out int trace_hit;
out vec3 trace_away;     // a hit
out vec3 trace_velocity; // none
out vec4 trace_point_clip;

void start_trace() {
    trace_searches = 0;
    trace_own_position = vec3(0.0);
    trace_neighbour_count = 0;
    trace_neighbour_texel = ivec2(0);
    trace_neighbour_reached = 0;
    trace_neighbour_position = vec3(0.0);
    trace_neighbour_apart = vec3(0.0);
    trace_neighbour_distance = 0.0;
    trace_hit = 0;
    trace_away = vec3(0.0);
    trace_velocity = vec3(0.0);
}
#define START_TRACE() start_trace()
#define TRACE_NEIGHBOUR(place, value) if (trace_neighbour_count == gl_InstanceID + 1) place = value
#else
#define START_TRACE()
#define TRACE_NEIGHBOUR(place, value)
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

// Lines 5 to 19. True when a stored position lies within the collision range; `away` then is own minus nearest.
bool nearest_collision(ivec2 texel_base, out vec3 away) {
    away = vec3(0.0);
    TRACE(trace_searches, 1);
    precise vec3 curr_pos = a_Position;
#if SELF_POSITION == SELF_POSITION_TEXEL
    vec4 stored_self = texelFetch(u_CDTexture, texel_base, 0);
    if (!holds_particle(stored_self))
        return false;
    curr_pos = decode_position(stored_self);
#endif
    TRACE(trace_own_position, curr_pos);
    precise float particle_min_length = 100000.0;
    bool particle_collision = false;
    for (int ty = -u_TexelCollideRange; ty <= u_TexelCollideRange; ++ty) {
        for (int tx = -u_TexelCollideRange; tx <= u_TexelCollideRange; ++tx) {
            ivec2 texel = texel_base + ivec2(tx, ty);
            TRACE(trace_neighbour_count, trace_neighbour_count + 1);
            TRACE_NEIGHBOUR(trace_neighbour_texel, texel);
            if ((tx == 0 && ty == 0) || !on_image(texel))
                continue;
            vec4 stored = texelFetch(u_CDTexture, texel, 0);
            TRACE_NEIGHBOUR(trace_neighbour_reached, 1);
            if (!holds_particle(stored))
                continue;
            vec3 apart = sum(curr_pos, -decode_position(stored));
            float len = ls_length(apart);
            TRACE_NEIGHBOUR(trace_neighbour_reached, 2);
            TRACE_NEIGHBOUR(trace_neighbour_position, decode_position(stored));
            TRACE_NEIGHBOUR(trace_neighbour_apart, apart);
            TRACE_NEIGHBOUR(trace_neighbour_distance, len);
#if ZERO_DISTANCE == ZERO_DISTANCE_SKIP
            if (len == 0.0)
                continue;
#endif
            TRACE_NEIGHBOUR(trace_neighbour_reached, 3);
            if (u_CollisionRange > len && len < particle_min_length) {
                particle_min_length = len;
                away = apart;
                particle_collision = true;
                TRACE_NEIGHBOUR(trace_neighbour_reached, 4);
            }
        }
    }
    return particle_collision;
}

// Lines 21 to 24.
void collide(vec3 away) {
    TRACE(trace_hit, 1);
    TRACE(trace_away, away);
#if VELOCITY == VELOCITY_VECTOR
    v_Dir = product(ls_normalize(away), product(ls_length(a_Dir), u_SpeedFactor));
    v_Speed = ls_flush(a_Speed);
#else
    v_Speed = product(a_Speed, u_SpeedFactor);
    v_Dir = ls_normalize(away);
#endif
    v_CollideTime = u_CollisionTime;
    vec3 step = product(v_Dir, v_Speed);
#if COLLISION_STEP == COLLISION_STEP_TICK
    step = product(step, u_Tick);
#endif
    v_Position = sum(a_Position, step);
}

// Lines 26 to 30.
void integrate() {
    vec3 temp = sum(product(a_Dir, a_Speed), product(u_Gravity, u_Tick));
    TRACE(trace_velocity, temp);
#if VELOCITY == VELOCITY_VECTOR
    v_Dir = temp;
    v_Speed = ls_flush(a_Speed);
#else
    v_Dir = ls_normalize(temp);
    v_Speed = ls_length(temp);
#endif
    precise float collide_time = ls_flush(a_CollideTime) - u_Tick;
    v_CollideTime = ls_flush(collide_time);
    v_Position = sum(a_Position, product(product(v_Dir, v_Speed), u_Tick));
}

// By the listing's indentation, lines 9 to 30 belong to those that search.
void stand() {
    v_Position = ls_flush3(a_Position);
    v_Dir = ls_flush3(a_Dir);
    v_Speed = ls_flush(a_Speed);
    v_CollideTime = ls_flush(a_CollideTime);
}

void main() {
    START_TRACE();
    ivec2 texel_base;
    vec3 away;
    bool visible = base_texel(image_position(ls_transform(u_ProjView, a_Position)), texel_base);
    TRACE(trace_clip, last_clip);
    TRACE(trace_ndc, last_ndc);
    TRACE(trace_texture_coordinate, last_texture_coordinate);
    TRACE(trace_image_position, last_image_position);
    TRACE(trace_base_texel, visible ? texel_base : ivec2(-1));
#if NOT_SEARCHING == NOT_SEARCHING_STANDS
    if (!(0.0 > ls_flush(a_CollideTime)))
        stand();
    else
#endif
    if (ls_flush(a_CollideTime) < 0.0 && visible && nearest_collision(texel_base, away))
        collide(away);
    else
        integrate();
#if RASTER_POSITION == RASTER_POSITION_UPDATED
    vec4 clip = ls_transform(u_ProjView, v_Position);
#else
    vec4 clip = ls_transform(u_ProjView, a_Position);
#endif
    TRACE(trace_point_clip, clip);
    gl_Position = point_position(clip);
}
