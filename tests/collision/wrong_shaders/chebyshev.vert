#version 450
// cause: chebyshev_distance, in crowd
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

// From the far corner to the near one; <= lets the one met last, the first in reading order, win a tie.
int scan(ivec2 o, vec3 x, out vec3 sep)
{
    int found = 0;
    float m = 3.4e38;
    sep = vec3(0.0);
    int j = u_TexelCollideRange;
    while (j >= -u_TexelCollideRange) {
        int i = u_TexelCollideRange;
        while (i >= -u_TexelCollideRange) {
            ivec2 a = o + ivec2(i, j);
            bool self = (i == 0) && (j == 0);
            bool out_of_it = a.x < 0 || a.y < 0 || a.x > u_ClientWidth - 1 || a.y > u_ClientHeight - 1;
            if (!self && !out_of_it) {
                vec4 z = texelFetch(u_CDTexture, a, 0);
                precise vec3 s = x - z.xyz;
                precise float n = max(abs(s.x), max(abs(s.y), abs(s.z)));
                if (z.w != 0.0 && n != 0.0 && n < u_CollisionRange && n <= m) {
                    m = n;
                    sep = s;
                    ++found;
                }
            }
            --i;
        }
        --j;
    }
    return found;
}

void main()
{
    precise vec4 cp = u_ProjView * vec4(a_Position, 1.0);
    precise vec2 f = (vec2(cp.x / cp.w, cp.y / cp.w) + 1.0) * 0.5;
    precise float fx = f.x * float(u_ClientWidth);
    precise float fy = f.y * float(u_ClientHeight);
    vec3 sep;
    int found = 0;
    if (a_CollideTime < 0.0)
        if (fx >= 0.0 && fx < float(u_ClientWidth))
            if (fy >= 0.0 && fy < float(u_ClientHeight))
                found = scan(ivec2(int(fx), int(fy)), a_Position, sep);

    switch (found) {
    case 0: {
        precise vec3 nv = a_Dir * a_Speed + u_Gravity * u_Tick;
        v_Speed = length(nv);
        v_Dir = normalize(nv);
        v_CollideTime = a_CollideTime - u_Tick;
        break;
    }
    default:
        v_Speed = a_Speed * u_SpeedFactor;
        v_Dir = normalize(sep);
        v_CollideTime = u_CollisionTime;
    }
    precise vec3 move = v_Dir * v_Speed;
    move = move * u_Tick;
    v_Position = a_Position + move;
    precise vec4 np = u_ProjView * vec4(v_Position, 1.0);
    gl_Position = np;
}
