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

int order(ivec2 d) { return d.y * 1024 + d.x; }
void main() {
    precise vec4 c = u_ProjView * vec4(a_Position, 1.0);
    precise vec2 q = (c.xy / c.w + 1.0) * 0.5 * vec2(u_ClientWidth, u_ClientHeight);
    float d0 = u_CollisionRange;
    ivec2 o0 = ivec2(0);
    precise vec3 g0 = vec3(0.0);
    if (a_CollideTime < 0.0 && q.x >= 0.0 && q.y >= 0.0 && q.x < float(u_ClientWidth) && q.y < float(u_ClientHeight)) {
        ivec2 b = ivec2(floor(q));
        for (int ring = 1; ring <= u_TexelCollideRange; ++ring) {
            int n = 8 * ring;
            ivec2 o = ivec2(-ring, -ring);
            ivec2 step_ = ivec2(1, 0);
            for (int k = 0; k < n; ++k) {
                ivec2 t = b + o;
                if (t.x >= 0 && t.y >= 0 && t.x < u_ClientWidth && t.y < u_ClientHeight) {
                    vec4 s = texelFetch(u_CDTexture, t, 0);
                    if (s.a > 0.0) {
                        precise vec3 g = a_Position - s.xyz;
                        precise float d = length(g);
                        if (d > 0.0 && d < u_CollisionRange && (d < d0 || (d == d0 && order(o) < order(o0)))) {
                            d0 = d; o0 = o; g0 = g;
                        }
                    }
                }
                if (abs(o.x + step_.x) > ring || abs(o.y + step_.y) > ring) step_ = ivec2(-step_.y, step_.x);
                o += step_;
            }
        }
    }
    precise vec3 dir;
    if (o0 == ivec2(0)) {
        precise vec3 v = a_Dir * a_Speed + u_Gravity * u_Tick;
        dir = normalize(v);
        v_Speed = length(v);
        v_CollideTime = a_CollideTime - u_Tick;
    } else {
        dir = normalize(g0);
        v_Speed = a_Speed * u_SpeedFactor;
        v_CollideTime = u_CollisionTime;
    }
    v_Dir = dir;
    v_Position = a_Position + dir * v_Speed * u_Tick;
    gl_Position = u_ProjView * vec4(v_Position, 1.0);
}
