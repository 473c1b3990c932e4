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
out vec3 v_Position;
out vec3 v_Dir;
out float v_Speed;
out float v_CollideTime;

float separation(ivec2 t) {
    if (min(t.x, t.y) < 0 || t.x >= u_ClientWidth || t.y >= u_ClientHeight) return u_CollisionRange;
    vec4 there = texelFetch(u_CDTexture, t, 0);
    if (there.a == 0.0) return u_CollisionRange;
    float d = distance(a_Position, there.xyz);
    return d == 0.0 ? u_CollisionRange : d;
}

void main() {
    vec4 clip = u_ProjView * vec4(a_Position, 1.0);
    vec2 coord = (clip.xy / clip.w + 1.0) * 0.5 * vec2(u_ClientWidth, u_ClientHeight);
    bool searching = a_CollideTime < 0.0
        && coord.x >= 0.0 && coord.x < float(u_ClientWidth)
        && coord.y >= 0.0 && coord.y < float(u_ClientHeight);
    float shortest = u_CollisionRange;
    ivec2 winner = ivec2(-1);
    if (searching) {
        ivec2 mine = ivec2(coord);
        ivec2 from = mine - u_TexelCollideRange;
        ivec2 to = mine + u_TexelCollideRange;
        for (int y = from.y; y <= to.y; ++y)
            for (int x = from.x; x <= to.x; ++x)
                if (mine != ivec2(x, y))
                    shortest = min(shortest, separation(ivec2(x, y)));
        if (shortest < u_CollisionRange)
            for (int y = to.y; y >= from.y; --y)
                for (int x = to.x; x >= from.x; --x)
                    if (mine != ivec2(x, y) && separation(ivec2(x, y)) == shortest)
                        winner = ivec2(x, y);
    }
    vec3 heading;
    if (winner.x >= 0) {
        heading = normalize(a_Position - texelFetch(u_CDTexture, winner, 0).xyz);
        v_Speed = a_Speed * u_SpeedFactor;
        v_CollideTime = u_CollisionTime;
    } else {
        vec3 momentum = a_Dir * a_Speed + u_Gravity * u_Tick;
        heading = normalize(momentum);
        v_Speed = length(momentum);
        v_CollideTime = a_CollideTime - u_Tick;
    }
    v_Dir = heading;
    v_Position = a_Position + heading * v_Speed * u_Tick;
    gl_Position = u_ProjView * vec4(v_Position, 1.0);
}
