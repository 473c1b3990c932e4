#version 330 core
// legal: any_order. The matrix by rows: dot of four, in an order of the driver's.

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

void main() {
    mat4 rows = transpose(u_ProjView);
    vec4 clip = vec4(dot(rows[0], vec4(a_Position, 1.0)), dot(rows[1], vec4(a_Position, 1.0)), dot(rows[2], vec4(a_Position, 1.0)), dot(rows[3], vec4(a_Position, 1.0)));
    vec2 ndc = clip.xy / clip.w;
    vec2 image = (ndc + 1.0) * 0.5 * vec2(u_ClientWidth, u_ClientHeight);
    bool on_image = image.x >= 0.0 && image.y >= 0.0 && image.x < float(u_ClientWidth) && image.y < float(u_ClientHeight);
    bool hit = false;
    vec3 away = vec3(0.0);
    if (a_CollideTime < 0.0 && on_image) {
        ivec2 base = ivec2(image);
        float best = 100000.0;
        for (int y = -u_TexelCollideRange; y <= u_TexelCollideRange; ++y)
            for (int x = -u_TexelCollideRange; x <= u_TexelCollideRange; ++x) {
                ivec2 texel = base + ivec2(x, y);
                if (x == 0 && y == 0)
                    continue;
                if (texel.x < 0 || texel.y < 0 || texel.x >= u_ClientWidth || texel.y >= u_ClientHeight)
                    continue;
                vec4 other = texelFetch(u_CDTexture, texel, 0);
                if (other.a == 0.0)
                    continue;
                vec3 apart = a_Position - other.xyz;
                float distance_to = length(apart);
                if (distance_to == 0.0)
                    continue;
                if (distance_to < u_CollisionRange && distance_to < best) {
                    best = distance_to;
                    away = apart;
                    hit = true;
                }
            }
    }
    if (hit) {
        out_Speed = a_Speed * u_SpeedFactor;
        out_Dir = normalize(away);
        out_CollideTime = u_CollisionTime;
        out_Position = a_Position + out_Dir * out_Speed * u_Tick;
    } else {
        vec3 velocity = a_Dir * a_Speed + u_Gravity * u_Tick;
        out_Dir = normalize(velocity);
        out_Speed = length(velocity);
        out_CollideTime = a_CollideTime - u_Tick;
        out_Position = a_Position + out_Dir * out_Speed * u_Tick;
    }
    gl_Position = vec4(dot(rows[0], vec4(out_Position, 1.0)), dot(rows[1], vec4(out_Position, 1.0)), dot(rows[2], vec4(out_Position, 1.0)), dot(rows[3], vec4(out_Position, 1.0)));
}
