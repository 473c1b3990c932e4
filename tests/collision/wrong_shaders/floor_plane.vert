#version 420 core
// cause: kept_above_y, in behind_camera
#define W u_ClientWidth
#define H u_ClientHeight
#define R u_TexelCollideRange
#define DT u_Tick
#define READ(c) texelFetch(u_CDTexture, (c), 0)
#define INSIDE(c) ((c).x >= 0 && (c).y >= 0 && (c).x < W && (c).y < H)
#define FOR(v, n) for (int v = -(n); v <= (n); ++v)
#define IS_SET(t) ((t).w != 0.0)
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

layout(location = 0) in vec3 a_Position;
layout(location = 1) in vec3 a_Dir;
layout(location = 2) in float a_Speed;
layout(location = 3) in float a_CollideTime;
out vec3 v_Position;
out vec3 v_Dir;
out float v_Speed;
out float v_CollideTime;

bool look(in vec2 where, out vec3 push)
{
    push = vec3(0.0);
    if (where.x < 0.0 || where.y < 0.0) return false;
    if (where.x >= float(W) || where.y >= float(H)) return false;
    if (isnan(where.x) || isnan(where.y)) return false;
    ivec2 me = ivec2(where);
    float closest = u_CollisionRange;
    bool any_hit = false;
    FOR(row, R) {
        FOR(col, R) {
            ivec2 other = me + ivec2(col, row);
            if (other == me || !INSIDE(other)) continue;
            vec4 t = READ(other);
            if (IS_SET(t)) {
                vec3 d = a_Position - t.xyz;
                float l = sqrt(dot(d, d));
                if (l > 0.0 && l < closest) {
                    closest = l;
                    push = d;
                    any_hit = true;
                }
            }
        }
    }
    return any_hit;
}

void finish(vec3 dir, float speed, float timer)
{
    v_Dir = dir;
    v_Speed = speed;
    v_CollideTime = timer;
    v_Position = a_Position + (dir * speed) * DT;
    v_Position.y = max(v_Position.y, -0.4);
    gl_Position = u_ProjView * vec4(v_Position, 1.0);
}

void main()
{
    vec4 cs = u_ProjView * vec4(a_Position, 1.0);
    vec2 where = (cs.xy / cs.w + 1.0) * 0.5 * vec2(W, H);
    vec3 push;
    if (a_CollideTime < 0.0) {
        if (look(where, push)) {
            finish(normalize(push), a_Speed * u_SpeedFactor, u_CollisionTime);
            return;
        }
    }
    vec3 vel = a_Dir * a_Speed + u_Gravity * DT;
    finish(normalize(vel), length(vel), a_CollideTime - DT);
}
