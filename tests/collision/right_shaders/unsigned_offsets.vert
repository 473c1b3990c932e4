#version 450
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

void main() {
    precise vec4 c = u_ProjView * vec4(a_Position, 1.0);
    precise vec2 n = c.xy / c.w;
    precise vec2 q = (n + 1.0) * 0.5 * vec2(u_ClientWidth, u_ClientHeight);
    uint R = uint(u_TexelCollideRange), D = 2u * R + 1u;
    uint best = floatBitsToUint(u_CollisionRange);
    precise vec3 g = vec3(0.0);
    uint hits = 0u;
    bool go = a_CollideTime < 0.0;
    go = go && all(greaterThanEqual(q, vec2(0.0))) && all(lessThan(q, vec2(u_ClientWidth, u_ClientHeight)));
    if (go) {
        uvec2 b = uvec2(q);
        for (uint i = 0u; i < D * D; i++) {
            uvec2 t = b + uvec2(i % D, i / D) - R; // wraps below 0, and then is too large
            if (t == b || t.x >= uint(u_ClientWidth) || t.y >= uint(u_ClientHeight)) continue;
            vec4 s = texelFetch(u_CDTexture, ivec2(t), 0);
            if (floatBitsToUint(s.a) == 0u) continue;
            precise vec3 h = a_Position - s.xyz;
            precise float l = length(h);
            uint u = floatBitsToUint(l);
            if (u != 0u && u < best) { best = u; g = h; hits++; }
        }
    }
    precise vec3 dir; precise float s; precise float t;
    if (hits > 0u) { dir = normalize(g); s = a_Speed * u_SpeedFactor; t = u_CollisionTime; }
    else { precise vec3 v = a_Dir * a_Speed + u_Gravity * u_Tick; dir = normalize(v); s = length(v); t = a_CollideTime - u_Tick; }
    v_Dir = dir; v_Speed = s; v_CollideTime = t;
    v_Position = a_Position + dir * s * u_Tick;
    gl_Position = u_ProjView * vec4(v_Position, 1.0);
}
