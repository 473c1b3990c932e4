#version 430 core
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

const float FAR = 1e5;

void main()
{
    // xyz: from the neighbour to us, w: how far
    precise vec4 best = vec4(0, 0, 0, FAR);
    precise vec4 pv = vec4(a_Dir * a_Speed, a_CollideTime);
    precise vec4 h = (u_ProjView[0] * a_Position.x + u_ProjView[1] * a_Position.y) + (u_ProjView[2] * a_Position.z + u_ProjView[3]);
    precise vec2 st = (h.xy / h.w + 1.0) * 0.5;
    st *= vec2(u_ClientWidth, u_ClientHeight);
    ivec2 limit = ivec2(u_ClientWidth, u_ClientHeight);
    bool awake = pv.w < 0.0;
    bool seen = st.x >= 0.0 && st.y >= 0.0 && st.x < float(limit.x) && st.y < float(limit.y);
    if (awake && seen)
    {
        ivec2 c = ivec2(floor(st));
        int side = 2 * u_TexelCollideRange + 1;
        int centre = (side * side) / 2;
        for (int i = 0; i < side * side; ++i)
        {
            if (i == centre) continue;
            ivec2 q = c + ivec2(i % side, i / side) - u_TexelCollideRange;
            if (any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, limit))) continue;
            vec4 s = texelFetch(u_CDTexture, q, 0);
            precise vec4 cand;
            cand.xyz = a_Position - s.xyz;
            cand.w = length(cand.xyz);
            bool better = s.a != 0.0 && cand.w > 0.0 && cand.w < u_CollisionRange && cand.w < best.w;
            best = better ? cand : best;
        }
    }
    bool hit = best.w < FAR;
    precise vec4 drop = vec4(pv.xyz + u_Gravity * u_Tick, pv.w - u_Tick);
    if (hit) { v_Dir = normalize(best.xyz); v_Speed = a_Speed * u_SpeedFactor; v_CollideTime = u_CollisionTime; }
    else     { v_Dir = normalize(drop.xyz); v_Speed = length(drop.xyz);        v_CollideTime = drop.w; }
    precise vec3 v = v_Dir * v_Speed;
    v_Position = a_Position + v * u_Tick;
    precise vec4 o = u_ProjView[0] * v_Position.x + u_ProjView[1] * v_Position.y + u_ProjView[2] * v_Position.z + u_ProjView[3];
    gl_Position = o;
}
