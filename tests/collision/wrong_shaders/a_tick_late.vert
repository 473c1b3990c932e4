#version 450 core
// cause: searches_a_tick_late, in crowd
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
    precise vec4 clip = u_ProjView * vec4(a_Position, 1.0);
    vec2 wh = vec2(textureSize(u_CDTexture, 0));
    precise vec2 xy = (clip.xy / clip.ww + 1.0) * 0.5 * wh;
    int key = -1;
    precise float d_min = u_CollisionRange;
    precise vec3 gap = vec3(1.0, 0.0, 0.0);
    bool start = a_CollideTime < -u_Tick;
    start = start && xy == clamp(xy, vec2(0.0), wh) && xy.x != wh.x && xy.y != wh.y;
    if (start) {
        ivec2 b = ivec2(xy);
        ivec2 s = textureSize(u_CDTexture, 0);
        int R = u_TexelCollideRange;
        for (int x = max(0, b.x - R); x < min(s.x, b.x + R + 1); x++) {
            for (int y = max(0, b.y - R); y < min(s.y, b.y + R + 1); y++) {
                if (x == b.x && y == b.y) continue;
                vec4 n = texelFetch(u_CDTexture, ivec2(x, y), 0);
                if (n.w == 0.0) continue;
                precise vec3 g = a_Position - n.xyz;
                precise float d = length(g);
                int k = y * s.x + x;
                if (d == 0.0 || d >= u_CollisionRange) continue;
                if (d < d_min || (d == d_min && k < key)) {
                    d_min = d;
                    gap = g;
                    key = k;
                }
            }
        }
    }
    precise vec3 velocity;
    if (key >= 0) {
        v_CollideTime = u_CollisionTime;
        v_Speed = a_Speed * u_SpeedFactor;
        v_Dir = normalize(gap);
        velocity = v_Dir * v_Speed;
    } else {
        velocity = a_Dir * a_Speed;
        velocity += u_Gravity * u_Tick;
        v_CollideTime = a_CollideTime - u_Tick;
        v_Speed = length(velocity);
        v_Dir = normalize(velocity);
        velocity = v_Dir * v_Speed;
    }
    v_Position = a_Position + velocity * u_Tick;
    gl_Position = u_ProjView * vec4(v_Position, 1.0);
}
