#version 450 core
// cause: disc_searched, in crowd
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
precise gl_Position;

#define ROW(y) ivec2(-3, y), ivec2(-2, y), ivec2(-1, y), ivec2(0, y), ivec2(1, y), ivec2(2, y), ivec2(3, y)
const ivec2 OFFSETS[49] = ivec2[49](ROW(-3), ROW(-2), ROW(-1), ROW(0), ROW(1), ROW(2), ROW(3));

vec4 sampleAt(ivec2 t) {
    bool bad = t.x < 0 || t.y < 0 || t.x >= u_ClientWidth || t.y >= u_ClientHeight;
    if (bad) return vec4(0.0);
    return texelFetch(u_CDTexture, t, 0);
}

vec2 locate(vec3 p) {
    precise vec4 c = u_ProjView * vec4(p, 1.0);
    precise vec2 r = vec2(c.x / c.w, c.y / c.w) + vec2(1.0, 1.0);
    r = r * 0.5;
    r.x *= float(u_ClientWidth);
    r.y *= float(u_ClientHeight);
    return r;
}

void main() {
    bool collided = false;
    precise vec3 normal = vec3(0.0);
    float minimum = u_CollisionRange;
    vec2 place = locate(a_Position);
    if (a_CollideTime < 0.0 && place.x >= 0.0 && place.y >= 0.0
        && place.x < float(u_ClientWidth) && place.y < float(u_ClientHeight)) {
        ivec2 origin = ivec2(place);
        for (int k = 0; k < OFFSETS.length(); ++k) {
            ivec2 o = OFFSETS[k];
            if (o.x * o.x + o.y * o.y > u_TexelCollideRange * u_TexelCollideRange) continue;
            if (o == ivec2(0)) continue;
            vec4 nb = sampleAt(origin + o);
            if (nb.w == 0.0) continue;
            precise vec3 toMe = a_Position - nb.xyz;
            precise float dd = length(toMe);
            if (dd > 0.0 && minimum > dd) {
                minimum = dd;
                normal = toMe;
                collided = true;
            }
        }
    }
    precise vec3 d;
    precise float s;
    precise float t;
    if (!collided) {
        precise vec3 old = a_Dir * a_Speed;
        precise vec3 pull = u_Gravity * u_Tick;
        precise vec3 now = old + pull;
        d = normalize(now);
        s = length(now);
        t = a_CollideTime - u_Tick;
    } else {
        d = normalize(normal);
        s = a_Speed * u_SpeedFactor;
        t = u_CollisionTime;
    }
    precise vec3 travel = d * s * u_Tick;
    precise vec3 x = a_Position + travel;
    v_Position = x;
    v_Dir = d;
    v_Speed = s;
    v_CollideTime = t;
    gl_Position = u_ProjView * vec4(x, 1.0);
}
