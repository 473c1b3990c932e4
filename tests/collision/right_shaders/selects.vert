#version 450 core
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

in vec3 a_Position;
in vec3 a_Dir;
in float a_Speed;
in float a_CollideTime;
precise out vec3 v_Position;
precise out vec3 v_Dir;
precise out float v_Speed;
precise out float v_CollideTime;
precise gl_Position;

vec3 pick(bool c, vec3 yes, vec3 no) { return c ? yes : no; }
float pick(bool c, float yes, float no) { return c ? yes : no; }

void main() {
    precise vec4 clip = u_ProjView * vec4(a_Position, 1.0);
    precise vec2 loc = (clip.xy / clip.w + 1.0) * 0.5 * vec2(u_ClientWidth, u_ClientHeight);
    bvec4 sides = bvec4(loc.x >= 0.0, loc.y >= 0.0, loc.x < float(u_ClientWidth), loc.y < float(u_ClientHeight));
    bool search = all(sides) && a_CollideTime < 0.0;
    int R = search ? u_TexelCollideRange : -1;
    ivec2 base = search ? ivec2(loc) : ivec2(0);
    precise vec3 delta = vec3(0.0);
    precise float dist = 1.0e5;
    for (int y = -R; y <= R; ++y)
        for (int x = -R; x <= R; ++x) {
            ivec2 p = base + ivec2(x, y);
            bool ok = (x | y) != 0 && uint(p.x) < uint(u_ClientWidth) && uint(p.y) < uint(u_ClientHeight);
            ivec2 safe = ok ? p : base;
            vec4 s = texelFetch(u_CDTexture, safe, 0);
            precise vec3 d = a_Position - s.xyz;
            precise float l = length(d);
            ok = ok && s.a != 0.0;
            ok = ok && l != 0.0;
            ok = ok && l < u_CollisionRange;
            ok = ok && l < dist;
            delta = pick(ok, d, delta);
            dist = pick(ok, l, dist);
        }
    bool hit = dist < 1.0e5;
    precise vec3 free_fall = a_Dir * a_Speed + u_Gravity * u_Tick;
    precise vec3 axis = pick(hit, delta, free_fall);
    v_Dir = normalize(axis);
    precise float damped = a_Speed * u_SpeedFactor;
    v_Speed = pick(hit, damped, length(free_fall));
    precise float waited = a_CollideTime - u_Tick;
    v_CollideTime = pick(hit, u_CollisionTime, waited);
    v_Position = a_Position + v_Dir * v_Speed * u_Tick;
    gl_Position = u_ProjView * vec4(v_Position, 1.0);
}
