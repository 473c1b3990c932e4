#version 330 core
// cause: search_ends_with_first_ring, in near_ties
#extension GL_ARB_gpu_shader5 : require
// Walks square rings round the base texel, nearest ring first. Equal distances: the lower row wins, then the lower column.
in vec3 a_Position;
in vec3 a_Dir;
in float a_Speed;
in float a_CollideTime;

uniform mat4 u_ProjView;
uniform sampler2D u_CDTexture;
uniform int u_ClientWidth;
uniform int u_ClientHeight;
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

ivec2 ring_cell(int ring, int i) {
    int edge = 2 * ring;
    int side = i / edge;
    int along = i - side * edge;
    if (side == 0) return ivec2(along - ring, -ring);
    if (side == 1) return ivec2(ring, along - ring);
    if (side == 2) return ivec2(ring - along, ring);
    return ivec2(-ring, ring - along);
}

bool earlier(ivec2 a, ivec2 b) {
    return a.y != b.y ? a.y < b.y : a.x < b.x;
}

bool search(ivec2 centre, vec3 me, out vec3 normal) {
    normal = vec3(0.0);
    precise vec3 best_d = vec3(0.0);
    float best = 100000.0;
    ivec2 best_cell = ivec2(0);
    bool any_hit = false;
    for (int ring = 1; ring <= u_TexelCollideRange && !any_hit; ++ring) {
        for (int i = 0; i < 8 * ring; ++i) {
            ivec2 rel = ring_cell(ring, i);
            ivec2 cell = centre + rel;
            if (min(cell.x, cell.y) < 0 || cell.x >= u_ClientWidth || cell.y >= u_ClientHeight)
                continue;
            vec4 stored = texelFetch(u_CDTexture, cell, 0);
            if (stored.a == 0.0)
                continue;
            precise vec3 d = me - stored.xyz;
            float l = length(d);
            if (l == 0.0 || !(l < u_CollisionRange))
                continue;
            if (l < best || (l == best && earlier(rel, best_cell))) {
                best = l;
                best_d = d;
                best_cell = rel;
                any_hit = true;
            }
        }
    }
    if (any_hit)
        normal = normalize(best_d);
    return any_hit;
}

void main() {
    precise vec4 here = u_ProjView * vec4(a_Position, 1.0);
    precise vec2 ndc = vec2(here.x / here.w, here.y / here.w);
    precise vec2 pix = vec2((ndc.x + 1.0) * 0.5 * float(u_ClientWidth), (ndc.y + 1.0) * 0.5 * float(u_ClientHeight));
    bool seen = pix.x >= 0.0 && pix.x < float(u_ClientWidth) && pix.y >= 0.0 && pix.y < float(u_ClientHeight);
    vec3 normal;
    bool hit = false;
    if (seen && a_CollideTime < 0.0)
        hit = search(ivec2(pix), a_Position, normal);

    precise vec3 velocity;
    if (hit) {
        v_Dir = normal;
        v_Speed = a_Speed * u_SpeedFactor;
        v_CollideTime = u_CollisionTime;
    } else {
        velocity = a_Dir * a_Speed;
        velocity += u_Gravity * u_Tick;
        v_Dir = normalize(velocity);
        v_Speed = length(velocity);
        v_CollideTime = a_CollideTime - u_Tick;
    }
    precise vec3 displacement = v_Dir * v_Speed * u_Tick;
    v_Position = a_Position + displacement;
    gl_Position = u_ProjView * vec4(v_Position, 1.0);
}
