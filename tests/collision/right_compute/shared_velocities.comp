#version 430 core
// The shipped files' pieces, groups of 128 that load their particles into shared memory, rows from above.
#include "arithmetic.glsl"
#include "collision_code.glsl"
#include "base_texel.glsl"
#include "nearest_particle.glsl"

layout(local_size_x = 128) in;

struct Grain {
    vec3 at;
    float fast;
    vec3 along;
    float rest;
};
layout(std430, binding = 0) readonly buffer From { Grain from[]; };
layout(std430, binding = 1) writeonly buffer To { Grain to[]; };

uniform uint u_ParticleCount;
uniform mat4 u_ProjView;
uniform sampler2D u_CDTexture;
uniform int u_TexelCollideRange;
uniform float u_CollisionRange, u_CollisionTime, u_SpeedFactor, u_Tick;
uniform vec3 u_Gravity;

shared Grain loaded[128];

bool find_nearest(Grain g, ivec2 base, out vec3 away) {
    bool found = false;
    float best = u_CollisionRange;
    // The first of equals is that of the lowest row and column: from above, an equal one takes its place.
    for (int dy = u_TexelCollideRange; dy >= -u_TexelCollideRange; --dy)
        for (int dx = u_TexelCollideRange; dx >= -u_TexelCollideRange; --dx) {
            ivec2 texel = base + ivec2(dx, dy);
            bool own = dx == 0 && dy == 0;
            if (own || texel.x < 0 || texel.y < 0 || texel.x >= u_ClientWidth || texel.y >= u_ClientHeight)
                continue;
            vec4 stored = texelFetch(u_CDTexture, texel, 0);
            if (stored.a == 0.0)
                continue;
            precise vec3 apart = g.at - decode_position(stored);
            float len = ls_length(apart);
            if (len != 0.0 && len < u_CollisionRange && len <= best) {
                best = len;
                away = apart;
                found = true;
            }
        }
    return found;
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    loaded[gl_LocalInvocationID.x] = from[min(i, u_ParticleCount - 1u)];
    barrier();
    if (i >= u_ParticleCount)
        return;
    Grain g = loaded[gl_LocalInvocationID.x];
    ivec2 base;
    vec3 away = vec3(0.0);
    bool seen = base_texel(image_position(ls_transform(u_ProjView, g.at)), base);
    bool hit = g.rest < 0.0 && seen && find_nearest(g, base, away);
    precise vec3 pulled = g.along * g.fast;
    precise vec3 pull = u_Gravity * u_Tick;
    precise vec3 velocity = pulled + pull;
    precise float fast = hit ? g.fast * u_SpeedFactor : ls_length(velocity);
    vec3 along = ls_normalize(hit ? away : velocity);
    precise vec3 moved = along * fast;
    precise vec3 step = moved * u_Tick;
    precise vec3 at = g.at + step;
    precise float rest = hit ? u_CollisionTime : g.rest - u_Tick;
    to[i] = Grain(at, fast, along, rest);
    offer_to_texel(i, ls_transform(u_ProjView, at));
}
