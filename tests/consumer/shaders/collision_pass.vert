#version 330 core
#extension GL_ARB_gpu_shader5 : require
// An engine's own vertex stage of the collision pass: what is not `precise` here is another sum on every driver.

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

precise out vec3 v_Position;
precise out vec3 v_Dir;
precise out float v_Speed;
precise out float v_CollideTime;
precise gl_Position;

bool on_image(vec2 p) {
    return p.x >= 0.0 && p.y >= 0.0 && p.x < float(u_ClientWidth) && p.y < float(u_ClientHeight);
}

// From the nearest particle on the image to this one; false if none is within the collision range.
bool find_nearest(ivec2 own, out vec3 away) {
    away = vec3(0.0);
    float nearest = u_CollisionRange;
    for (int y = -u_TexelCollideRange; y <= u_TexelCollideRange; ++y)
        for (int x = -u_TexelCollideRange; x <= u_TexelCollideRange; ++x) {
            ivec2 texel = own + ivec2(x, y);
            if (texel == own || !on_image(vec2(texel)))
                continue;
            vec4 stored = texelFetch(u_CDTexture, texel, 0);
            precise vec3 apart = a_Position - stored.xyz;
            float len = length(apart);
            if (stored.a != 0.0 && len > 0.0 && len < nearest) {
                nearest = len;
                away = apart;
            }
        }
    return away != vec3(0.0);
}

void main() {
    precise vec4 clip = u_ProjView * vec4(a_Position, 1.0);
    precise vec2 image = (clip.xy / clip.w + vec2(1.0)) * 0.5 * vec2(u_ClientWidth, u_ClientHeight);
    vec3 away;
    if (a_CollideTime < 0.0 && on_image(image) && find_nearest(ivec2(image), away)) {
        v_Speed = a_Speed * u_SpeedFactor;
        v_Dir = normalize(away);
        v_CollideTime = u_CollisionTime;
    } else {
        precise vec3 velocity = a_Dir * a_Speed + u_Gravity * u_Tick;
        v_Speed = length(velocity);
        v_Dir = normalize(velocity);
        v_CollideTime = a_CollideTime - u_Tick;
    }
    v_Position = a_Position + v_Dir * v_Speed * u_Tick;
    gl_Position = u_ProjView * vec4(v_Position, 1.0);
}
