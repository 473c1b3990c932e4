#version 430 core
// The particle pass of the depth comparator, one invocation a particle: engines hold particles against the scene's depth.
// Looks up the depth that was drawn where the particle is seen, brings it back to the world by the inverse matrix, takes
// the normal from the texels to the right and above, and answers where the particle lies closely behind, or lets gravity
// move it. Particles are not in that image and do not meet. Line numbers are the listing's (thesis, Fig. 3-3).

#include "arithmetic.glsl"
#include "base_texel.glsl"

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
    if (texel.x < 0 || texel.y < 0 || texel.x >= u_ClientWidth || texel.y >= u_ClientHeight)
        return false;
    vec4 stored = texelFetch(u_Depth, texel, 0);
    if (stored.a == 0.0)
        return false;
    precise vec3 ndc = vec3(ls_divide(float(texel.x) + 0.5, float(u_ClientWidth)),
                            ls_divide(float(texel.y) + 0.5, float(u_ClientHeight)), ls_flush(stored.r)) * 2.0 - 1.0;
    vec4 p = ls_transform(u_InverseProjView, ndc);
    position = vec3(ls_divide(p.x, p.w), ls_divide(p.y, p.w), ls_divide(p.z, p.w));
    distance = ls_divide(1.0, p.w);
    return true;
}

// True where the particle lies behind a surface by less than its thickness; `normal` then points out of it.
bool surface_hit(vec3 own, out vec3 normal) {
    normal = vec3(0.0);
    vec4 clip = ls_transform(u_ProjView, own);
    ivec2 texel;
    if (!(clip.w > 0.0) || !base_texel(image_position(clip), texel))
        return false;
    vec3 here, right, upper;
    float distance, unused;
    if (!surface(texel, here, distance))
        return false;
    float behind = sum(clip.w, -distance);
    if (!(behind > 0.0) || !(behind < u_SurfaceThickness))
        return false;
    if (!surface(texel + ivec2(1, 0), right, unused) || !surface(texel + ivec2(0, 1), upper, unused))
        return false;
    normal = cross_product(sum(right, -here), sum(upper, -here));
    return true;
}

// Lines 21 to 24.
Particle collide(Particle a, vec3 away) {
    Particle v;
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
    v.direction = ls_normalize(temp);
    v.speed = ls_length(temp);
    v.collide_time = sum(a.collide_time, -u_Tick);
    v.position = sum(a.position, product(product(v.direction, v.speed), u_Tick));
    return v;
}

void main() {
    uint self = gl_GlobalInvocationID.x;
    if (self >= u_ParticleCount)
        return;
    Particle a = before[self];
    vec3 normal;
    if (ls_flush(a.collide_time) < 0.0 && surface_hit(a.position, normal))
        after[self] = collide(a, normal);
    else
        after[self] = integrate(a);
}
