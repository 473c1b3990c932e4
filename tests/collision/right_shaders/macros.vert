#version 450 core
// Macros, short names, unsigned bounds, a do loop.

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

flat out vec3 out_Position;
out float out_Speed;
out vec3 out_Dir;
out float out_CollideTime;

#define R u_TexelCollideRange
#define SIZE uvec2(u_ClientWidth, u_ClientHeight)
#define PROJECT(p) (u_ProjView * vec4((p), 1))
#define TEXEL(t) texelFetch(u_CDTexture, (t), 0)
#define NEXT(dir, v) ((dir) * (v) * u_Tick)

void main() {
    vec4 c = PROJECT(a_Position);
    vec2 w = (c.xy / c.ww + 1) * .5 * vec2(SIZE);
    ivec2 b = ivec2(floor(w));
    vec4 n = vec4(0, 0, 0, 1e5);
    if (a_CollideTime < 0 && all(lessThan(uvec2(b), SIZE))) {
        ivec2 o = ivec2(-R);
        do {
            ivec2 t = b + o;
            if (o != ivec2(0) && all(lessThan(uvec2(t), SIZE))) {
                vec4 s = TEXEL(t);
                vec3 d = a_Position - s.xyz;
                float l = length(d);
                if (s.a != 0 && l != 0 && l < u_CollisionRange && l < n.w)
                    n = vec4(d, l);
            }
            if (++o.x > R) { o.x = -R; ++o.y; }
        } while (o.y <= R);
    }
    if (n.w != 1e5) {
        out_Dir = normalize(n.xyz);
        out_Speed = u_SpeedFactor * a_Speed;
        out_CollideTime = u_CollisionTime;
    } else {
        vec3 v = u_Tick * u_Gravity + a_Speed * a_Dir;
        out_Dir = normalize(v);
        out_Speed = length(v);
        out_CollideTime = a_CollideTime - u_Tick;
    }
    out_Position = NEXT(out_Dir, out_Speed) + a_Position;
    gl_Position = PROJECT(out_Position);
}
