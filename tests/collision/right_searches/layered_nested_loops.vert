#version 330 core
#extension GL_ARB_gpu_shader5 : require
// Three loops in one another.

#include "arithmetic.glsl"
#include "collision_code.glsl"
#include "base_texel.glsl"

in vec3 a_Position;
in vec3 a_Dir;
in float a_Speed;
in float a_CollideTime;

uniform mat4 u_ProjView;
uniform mat4 u_SecondProjView;
uniform vec3 u_Reach; // projected_reach() of reference/model/collision/layered_cdt.hpp
uniform vec3 u_SecondReach;
uniform float u_WindowMargin;
uniform sampler2DArray u_CDTexture;
uniform sampler2DArray u_Velocities;
uniform int u_Obstacles; // 1, or 0 where there are none, and their plane need not be looked at
uniform int u_TexelCollideRange;
uniform float u_CollisionRange;
uniform float u_CollisionTime;
uniform float u_SpeedFactor;
uniform float u_Tick;
uniform vec3 u_Gravity;

precise out vec3 out_Position;
precise out vec3 out_Dir;
precise out float out_Speed;
precise out float out_CollideTime;

const int layers = CDT_LAYERS + 1;
const int planes_a_camera = 1 + layers;

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

// First and last texel of the window along one axis.
ivec2 window(float at, float reach, int size) {
    int low = int(at) - u_TexelCollideRange;
    int high = int(at) + u_TexelCollideRange;
#if SEARCH_WINDOW == SEARCH_WINDOW_PROJECTED
    precise float r = reach + u_WindowMargin;
    if (reach >= 0.0 && r < float(u_TexelCollideRange)) {
        low = max(low, int(floor(sum(at, -r))));
        high = min(high, int(floor(sum(at, r))));
    }
#endif
    return ivec2(max(low, 0), min(high, size - 1));
}

// What the search has found so far.
struct Contacts {
    float least;  // distance to the nearest stored position; with mutual response to the nearest obstacle
    vec3 nearest; // own position minus that one
    bool near;
    vec3 change; // of the velocity, by contacts with particles
    bool pushed;
    bool seen; // whether the particle is itself stored
};

vec3 as_stored(vec3 v) { return ls_flush3(decode_position(encode_position(v))); }

void keep_nearest(vec3 apart, float len, inout Contacts contacts) {
    if (len < contacts.least) {
        contacts.least = len;
        contacts.nearest = apart;
        contacts.near = true;
    }
}

// What a contact adds to the velocity: -share * (1 + restitution) * the component of `relative` along `apart`.
vec3 bounce(vec3 relative, vec3 apart, float share) {
    float part = ls_divide(ls_dot(relative, apart), ls_dot(apart, apart));
    return product(apart, product(part, product(-share, sum(1.0, u_SpeedFactor))));
}

void meet(vec3 stored, ivec3 texel, bool obstacle, inout Contacts contacts) {
    vec3 self = as_stored(a_Position);
#if RESPONSE == RESPONSE_MUTUAL
    vec3 apart = sum(self, -stored); // as stored, so that both of a pair compute with the same numbers
#else
    vec3 apart = sum(a_Position, -stored);
#endif
    float len = ls_length(apart);
    bool own = stored == self;
    contacts.seen = contacts.seen || (own && !obstacle);
    if (own || len == 0.0 || !(u_CollisionRange > len))
        return;
#if RESPONSE == RESPONSE_MUTUAL
    if (!obstacle) {
        vec4 other = texelFetch(u_Velocities, texel, 0);
        vec3 relative = sum(as_stored(product(a_Dir, a_Speed)), -other.xyz);
        if (other.a != 0.0 && ls_dot(relative, apart) < 0.0) {
            contacts.change = sum(contacts.change, bounce(relative, apart, 0.5));
            contacts.pushed = true;
        }
        return;
    }
#endif
    keep_nearest(apart, len, contacts);
}

// All texels of the window, and in each the obstacle and the layers as far back as the range reaches. One loop, not three in
// one another: particles that run side by side have different windows, and each goes through its own.
void search(mat4 proj_view, vec3 reach, int first_plane, inout Contacts contacts) {
    vec4 clip = ls_transform(proj_view, a_Position);
    vec2 at = image_position(clip);
    ivec2 base;
    if (!base_texel(at, base))
        return;
    float before = sum(clip.w, -reach.z);
    float behind = sum(clip.w, reach.z);
    ivec2 columns = window(at.x, ls_divide(reach.x, before), u_ClientWidth);
    ivec2 rows = window(at.y, ls_divide(reach.y, before), u_ClientHeight);
    for (int y = rows.x; y <= rows.y; ++y)
        for (int x = columns.x; x <= columns.y; ++x)
            for (int plane = 1 - u_Obstacles; plane <= layers; ++plane) {
                ivec3 texel = ivec3(x, y, first_plane + plane);
                vec4 stored = texelFetch(u_CDTexture, texel, 0);
                if (stored.a == 0.0) {
                    if (plane == 0)
                        continue;
                    break;
                }
                vec3 position = ls_flush3(decode_position(stored));
                if (ls_transform(proj_view, position).w > behind) {
                    if (plane == 0)
                        continue;
                    break;
                }
                meet(position, texel, plane == 0, contacts);
            }
}

// The new velocity, where there is a contact to answer.
#if RESPONSE == RESPONSE_MUTUAL
bool velocity_after(Contacts contacts, out vec3 velocity) {
    velocity = product(a_Dir, a_Speed);
    bool pushed = contacts.pushed && contacts.seen; // an unseen particle's push would have no counterpart
    if (pushed)
        velocity = sum(velocity, contacts.change);
    bool reflected = contacts.near && ls_dot(velocity, contacts.nearest) < 0.0;
    if (reflected)
        velocity = sum(velocity, bounce(velocity, contacts.nearest, 1.0));
    return pushed || reflected;
}
#endif

void move(vec3 velocity) {
#if COLLISION_STEP == COLLISION_STEP_TICK
    velocity = product(velocity, u_Tick);
#endif
    out_Position = sum(a_Position, velocity);
}

bool answer(Contacts contacts) {
#if RESPONSE == RESPONSE_MUTUAL
    vec3 velocity;
    if (!velocity_after(contacts, velocity))
        return false;
    out_Speed = ls_length(velocity);
    out_Dir = ls_flush3(a_Dir);
    if (out_Speed != 0.0)
        out_Dir = ls_normalize(velocity);
    move(velocity);
#else
    if (!contacts.near)
        return false;
    out_Speed = product(a_Speed, u_SpeedFactor);
    out_Dir = ls_normalize(contacts.nearest);
    move(product(out_Dir, out_Speed));
#endif
    out_CollideTime = u_CollisionTime;
    return true;
}

void integrate() {
    vec3 velocity = sum(product(a_Dir, a_Speed), product(u_Gravity, u_Tick));
    out_Dir = ls_normalize(velocity);
    out_Speed = ls_length(velocity);
    out_CollideTime = sum(a_CollideTime, -u_Tick);
    out_Position = sum(a_Position, product(product(out_Dir, out_Speed), u_Tick));
}

void main() {
    Contacts contacts = Contacts(100000.0, vec3(0.0), false, vec3(0.0), false, false);
    if (ls_flush(a_CollideTime) < 0.0) {
        search(u_ProjView, u_Reach, 0, contacts);
#if CDT_CAMERAS == CDT_CAMERAS_2
        search(u_SecondProjView, u_SecondReach, planes_a_camera, contacts);
#endif
    }
    if (!answer(contacts))
        integrate();
}
