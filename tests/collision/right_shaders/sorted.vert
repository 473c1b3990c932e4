#version 430
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
out vec3 v_Position;
out vec3 v_Dir;
out float v_Speed;
out float v_CollideTime;

vec4 list[49];
int count = 0;
void insert(vec4 e) {
    int i = count++;
    while (i > 0 && list[i - 1].w > e.w) { list[i] = list[i - 1]; --i; }
    list[i] = e;
}
void main() {
    vec4 p = vec4(a_Position, 1.0);
    vec4 c = u_ProjView * p;
    float tx = (c.x / c.w + 1.0) * 0.5 * float(u_ClientWidth);
    float ty = (c.y / c.w + 1.0) * 0.5 * float(u_ClientHeight);
    if (a_CollideTime < 0.0 && tx >= 0.0 && ty >= 0.0 && tx < float(u_ClientWidth) && ty < float(u_ClientHeight)) {
        int bx = int(tx), by = int(ty), R = u_TexelCollideRange;
        for (int j = max(by - R, 0); j <= min(by + R, u_ClientHeight - 1); ++j)
            for (int i = max(bx - R, 0); i <= min(bx + R, u_ClientWidth - 1); ++i) {
                if (i == bx && j == by) continue;
                vec4 t = texelFetch(u_CDTexture, ivec2(i, j), 0);
                if (t.w == 0.0) continue;
                vec3 g = p.xyz - t.xyz;
                float l = length(g);
                if (l > 0.0 && l < u_CollisionRange) insert(vec4(g, l));
            }
    }
    vec4 state; // velocity direction, speed
    if (count == 0) {
        vec3 v = a_Dir * a_Speed + u_Gravity * u_Tick;
        state = vec4(normalize(v), length(v));
        v_CollideTime = a_CollideTime - u_Tick;
    } else {
        state = vec4(normalize(list[0].xyz), a_Speed * u_SpeedFactor);
        v_CollideTime = u_CollisionTime;
    }
    v_Dir = state.xyz;
    v_Speed = state.w;
    v_Position = p.xyz + state.xyz * state.w * u_Tick;
    gl_Position = u_ProjView * vec4(v_Position, 1.0);
}
