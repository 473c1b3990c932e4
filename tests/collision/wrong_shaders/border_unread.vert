#version 450 core
// cause: border_never_read, in borders
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

in vec3 a_Position, a_Dir;
in float a_Speed, a_CollideTime;
precise out vec3 v_Position;
precise out vec3 v_Dir;
precise out float v_Speed;
precise out float v_CollideTime;
precise gl_Position;

void main() {
    const ivec2 size = ivec2(u_ClientWidth, u_ClientHeight);
    const vec2 extent = vec2(u_ClientWidth, u_ClientHeight);
    precise vec4 clip = u_ProjView * vec4(a_Position, 1.0);
    precise vec2 ndc = clip.xy / clip.w;
    precise vec2 pixel = ((ndc + 1.0) * 0.5) * extent;

    bool hit = false;
    precise vec3 nearest = vec3(0.0);
    precise float reach = u_CollisionRange;

    if (a_CollideTime < 0.0 && all(greaterThanEqual(pixel, vec2(0.0))) && all(lessThan(pixel, extent))) {
        const int r = u_TexelCollideRange;
        ivec2 home = ivec2(pixel);
        ivec2 lo = max(home - r, ivec2(1));
        ivec2 hi = min(home + r, size - 2);
        ivec2 p;
        for (p.y = lo.y; p.y <= hi.y; p.y++) {
            for (p.x = lo.x; p.x <= hi.x; p.x++) {
                if (p == home) continue;
                vec4 texel = texelFetch(u_CDTexture, p, 0);
                if (texel.a == 0.0) continue;
                precise vec3 apart = a_Position - texel.xyz;
                precise float dist = length(apart);
                if (dist == 0.0) continue;
                if (dist < reach) {
                    reach = dist;
                    nearest = apart;
                    hit = true;
                }
            }
        }
    }

    if (hit) {
        v_Dir = normalize(nearest);
        v_Speed = a_Speed * u_SpeedFactor;
        v_CollideTime = u_CollisionTime;
    } else {
        precise vec3 velocity = a_Dir * a_Speed + u_Gravity * u_Tick;
        v_Dir = normalize(velocity);
        v_Speed = length(velocity);
        v_CollideTime = a_CollideTime - u_Tick;
    }
    v_Position = a_Position + v_Dir * v_Speed * u_Tick;
    gl_Position = u_ProjView * vec4(v_Position, 1.0);
}
