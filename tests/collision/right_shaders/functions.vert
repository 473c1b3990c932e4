#version 330 core
// Small functions with out parameters and early returns.

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

bool on_image(ivec2 t) { return min(t.x, t.y) >= 0 && t.x < u_ClientWidth && t.y < u_ClientHeight; }

bool nearest(in ivec2 base, out vec3 away) {
    float best = 100000.0;
    away = vec3(0);
    for (int y = base.y - u_TexelCollideRange; y <= base.y + u_TexelCollideRange; y++) {
        for (int x = base.x - u_TexelCollideRange; x <= base.x + u_TexelCollideRange; x++) {
            ivec2 t = ivec2(x, y);
            if (t == base || !on_image(t)) continue;
            vec4 s = texelFetch(u_CDTexture, t, 0);
            vec3 d = a_Position - s.xyz;
            float l = length(d);
            if (s.w == 0.0 || l == 0.0 || l >= u_CollisionRange || l >= best) continue;
            best = l;
            away = d;
        }
    }
    return best < u_CollisionRange;
}

void finish(vec3 direction, float speed, float time) {
    out_Dir = direction;
    out_Speed = speed;
    out_CollideTime = time;
    out_Position = a_Position + direction * speed * u_Tick;
    gl_Position = u_ProjView * vec4(out_Position, 1.0);
}

void main() {
    vec4 p = u_ProjView * vec4(a_Position, 1.0);
    vec2 t = (p.xy / p.w + vec2(1.0)) * 0.5 * vec2(u_ClientWidth, u_ClientHeight);
    vec3 away;
    bool visible = all(greaterThanEqual(t, vec2(0.0))) && all(lessThan(t, vec2(u_ClientWidth, u_ClientHeight)));
    if (a_CollideTime >= 0.0 || !visible || !nearest(ivec2(t), away)) {
        vec3 velocity = a_Dir * a_Speed + u_Gravity * u_Tick;
        finish(normalize(velocity), length(velocity), a_CollideTime - u_Tick);
        return;
    }
    finish(normalize(away), a_Speed * u_SpeedFactor, u_CollisionTime);
}
