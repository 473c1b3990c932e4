#version 330 core
// cause: collide_time_counted_by_a_constant, in crowd
#extension GL_ARB_gpu_shader5 : require
// One function, leaves as soon as it knows. The window is walked backwards, so an equal distance replaces.
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

void main() {
    precise vec3 nearest = vec3(0.0);
    float nearest_len = -1.0;
    do {
        if (!(a_CollideTime < 0.0)) break;
        precise vec4 clip = u_ProjView * vec4(a_Position, 1.0);
        precise float px = (clip.x / clip.w + 1.0) * 0.5 * float(u_ClientWidth);
        precise float py = (clip.y / clip.w + 1.0) * 0.5 * float(u_ClientHeight);
        if (!(px >= 0.0)) break;
        if (!(py >= 0.0)) break;
        if (!(px < float(u_ClientWidth))) break;
        if (!(py < float(u_ClientHeight))) break;
        int bx = int(px);
        int by = int(py);
        for (int y = by + u_TexelCollideRange; y >= by - u_TexelCollideRange; y--) {
            if (y < 0) break;
            if (y >= u_ClientHeight) continue;
            for (int x = bx + u_TexelCollideRange; x >= bx - u_TexelCollideRange; x--) {
                if (x < 0) break;
                if (x >= u_ClientWidth) continue;
                if (x == bx && y == by) continue;
                vec4 texel = texelFetch(u_CDTexture, ivec2(x, y), 0);
                if (texel.a == 0.0) continue;
                precise vec3 diff = a_Position - texel.xyz;
                float len = length(diff);
                if (len == 0.0) continue;
                if (len >= u_CollisionRange) continue;
                if (nearest_len >= 0.0 && len > nearest_len) continue;
                nearest_len = len;
                nearest = diff;
            }
        }
    } while (false);

    if (nearest_len > 0.0) {
        v_Speed = a_Speed * u_SpeedFactor;
        v_Dir = normalize(nearest);
        v_CollideTime = u_CollisionTime;
        precise vec3 shift = v_Dir * v_Speed;
        v_Position = a_Position + shift * u_Tick;
        gl_Position = u_ProjView * vec4(v_Position, 1.0);
        return;
    }

    precise vec3 old_vel = a_Dir * a_Speed;
    precise vec3 vel = old_vel + u_Gravity * u_Tick;
    v_Dir = normalize(vel);
    v_Speed = length(vel);
    v_CollideTime = a_CollideTime - 1.0 / 60.0;
    precise vec3 shift = v_Dir * v_Speed;
    v_Position = a_Position + shift * u_Tick;
    gl_Position = u_ProjView * vec4(v_Position, 1.0);
}
