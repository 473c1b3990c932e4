#version 330 core
// A switch over states, arrays, constants with names.

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

const int FALLING = 0, SEARCHING = 1, BOUNCING = 2;
const float FAR = 100000.0;

void main() {
    int state = a_CollideTime < 0.0 ? SEARCHING : FALLING;
    vec3 found[2] = vec3[](vec3(0.0), vec3(0.0));
    if (state == SEARCHING) {
        vec4 clip = u_ProjView * vec4(a_Position, 1.0);
        vec2 place = (clip.xy / clip.w + vec2(1.0, 1.0)) * 0.5;
        place *= vec2(float(u_ClientWidth), float(u_ClientHeight));
        ivec2 base = ivec2(floor(place));
        state = FALLING;
        float best = FAR;
        bool seen = base.x >= 0 && base.y >= 0 && base.x < u_ClientWidth && base.y < u_ClientHeight;
        for (int dy = -u_TexelCollideRange; seen && dy <= u_TexelCollideRange; ++dy) {
            for (int dx = -u_TexelCollideRange; dx <= u_TexelCollideRange; ++dx) {
                int x = base.x + dx, y = base.y + dy;
                if ((dx | dy) == 0 || x < 0 || x >= u_ClientWidth || y < 0 || y >= u_ClientHeight)
                    continue;
                vec4 stored = texelFetch(u_CDTexture, ivec2(x, y), 0);
                found[1] = a_Position - stored.stp;
                float distance_now = length(found[1]);
                if (stored.q != 0.0 && distance_now != 0.0 && distance_now < u_CollisionRange && distance_now < best) {
                    best = distance_now;
                    found[0] = found[1];
                    state = BOUNCING;
                }
            }
        }
    }
    vec3 velocity = a_Dir * a_Speed + u_Gravity * u_Tick;
    switch (state) {
    case BOUNCING:
        out_Speed = a_Speed * u_SpeedFactor;
        out_Dir = normalize(found[0]);
        out_CollideTime = u_CollisionTime;
        break;
    default:
        out_Speed = length(velocity);
        out_Dir = normalize(velocity);
        out_CollideTime = a_CollideTime - u_Tick;
    }
    vec3 step_vector = out_Dir * out_Speed * u_Tick;
    out_Position = a_Position + step_vector;
    gl_Position = u_ProjView * vec4(out_Position, 1.0);
}
