#version 430 core
// The particle pass of the octree comparator (thesis, chapter 5), one invocation a particle: walks down the node
// texture to the leaf that holds the particle, finds the nearest of the leaf's entries, and answers, or lets gravity
// move it. What a leaf holds: reference/model/collision/octree.hpp. Line numbers are the listing's (Fig. 3-3).

#include "arithmetic.glsl"

layout(local_size_x = 64) in;

struct Particle {
    vec3 position;
    float speed;
    vec3 direction;
    float collide_time;
};

struct Node {
    vec3 box_min;
    uint entries;
    vec3 box_max;
    uint children;
    uint leaf;
    uint depth;
    uint first; // a leaf's entries are indices[first] to indices[first + entries - 1]
    uint unused;
};

layout(std430, binding = 0) readonly buffer Before { Particle before[]; };
layout(std430, binding = 1) writeonly buffer After { Particle after[]; };
layout(std430, binding = 2) readonly buffer Nodes { Node nodes[]; };
layout(std430, binding = 3) readonly buffer Indices { uint indices[]; }; // particles, then obstacles' vertices
layout(std430, binding = 4) readonly buffer ObstacleVertices { float obstacle_vertices[]; };
layout(std430, binding = 5) readonly buffer Order { uint order[]; }; // every particle once, leaf by leaf

// A texel a node: x and y of its first child, the number of children, the index into `nodes`.
uniform usampler2D u_NodeTexture;
uniform uint u_ParticleCount;
uniform float u_CollisionRange;
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

vec3 sum(vec3 a, vec3 b) {
    precise vec3 result = ls_flush3(a) + ls_flush3(b);
    return ls_flush3(result);
}

// Magnitudes of 2^-126 or less as 0, whatever the driver makes of subnormals.
float settled(float x) { return (floatBitsToInt(x) & 0x7fffffff) > 0x00800000 ? x : 0.0; }

bool holds(uint node, vec3 p) {
    return all(greaterThanEqual(p, nodes[node].box_min)) && all(lessThan(p, nodes[node].box_max));
}

// False where the particle lies outside the root.
bool find_leaf(vec3 position, out uint leaf) {
    vec3 p = vec3(settled(position.x), settled(position.y), settled(position.z));
    uvec4 node = texelFetch(u_NodeTexture, ivec2(0), 0);
    leaf = node.w;
    if (!holds(node.w, p))
        return false;
    while (node.z != 0u) {
        uvec4 inside = uvec4(0u); // stays a leaf, so that the walk ends, should no child hold it
        for (uint k = 0u; k < node.z; ++k) {
            uvec4 child = texelFetch(u_NodeTexture, ivec2(node.x + k, node.y), 0);
            if (holds(child.w, p))
                inside = child;
        }
        node = inside;
    }
    leaf = node.w;
    return nodes[leaf].leaf == 1u;
}

vec3 position_of(uint entry) {
    if (entry < u_ParticleCount)
        return before[entry].position;
    uint first = 3u * (entry - u_ParticleCount);
    return vec3(obstacle_vertices[first], obstacle_vertices[first + 1u], obstacle_vertices[first + 2u]);
}

// Lines 5 to 19, over the leaf's entries. True when one lies within the collision range; `away` then is own minus
// nearest.
bool nearest_collision(uint self, vec3 position, out vec3 away) {
    away = vec3(0.0);
    uint leaf;
    if (!find_leaf(position, leaf))
        return false;
    precise float particle_min_length = 100000.0;
    bool particle_collision = false;
    uint first = nodes[leaf].first;
    uint end = first + nodes[leaf].entries;
    for (uint i = first; i < end; ++i) {
        uint entry = indices[i];
        if (entry == self)
            continue;
        vec3 apart = sum(position, -position_of(entry));
        float len = ls_length(apart);
#if ZERO_DISTANCE == ZERO_DISTANCE_SKIP
        if (len == 0.0)
            continue;
#endif
        if (u_CollisionRange > len && len < particle_min_length) {
            particle_min_length = len;
            away = apart;
            particle_collision = true;
        }
    }
    return particle_collision;
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
    precise float collide_time = ls_flush(a.collide_time) - u_Tick;
    v.collide_time = ls_flush(collide_time);
    v.position = sum(a.position, product(product(v.direction, v.speed), u_Tick));
    return v;
}

void main() {
    if (gl_GlobalInvocationID.x >= u_ParticleCount)
        return;
    uint self = order[gl_GlobalInvocationID.x];
    Particle a = before[self];
    vec3 away = vec3(0.0);
    if (ls_flush(a.collide_time) < 0.0 && nearest_collision(self, a.position, away))
        after[self] = collide(a, away);
    else
        after[self] = integrate(a);
}
