#version 330 core
#extension GL_ARB_gpu_shader5 : require
// The listing of the thesis (Fig. 3-3) as a shader that can be checked. Line numbers are the listing's.

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

precise flat out vec3 out_Position; // flat: the fragment shader stores it
precise out float out_Speed;
precise out vec3 out_Dir;
precise out float out_CollideTime;
out float trace_particle_min_length; // lockstep explain shows it
precise gl_Position;

bool on_image(ivec2 texel) {
    return all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, ivec2(u_ClientWidth, u_ClientHeight)));
}

void main() {
    gl_Position = u_ProjView * vec4(a_Position, 1.0);                                              // 2
    precise vec2 tex_coord = (gl_Position.xy + vec2(1.0)) * 0.5;                                   // 3
    precise vec2 scaled = vec2(tex_coord.x * float(u_ClientWidth), tex_coord.y * float(u_ClientHeight));
    ivec2 texel_base = ivec2(scaled);                                                              // 4
    bool visible = all(greaterThan(scaled, vec2(-1.0))) && on_image(texel_base);
    vec3 curr_pos = visible ? texelFetch(u_CDTexture, texel_base, 0).xyz : a_Position;             // 5
    precise float particle_min_length = 100000.0;                                                  // 6
    precise vec3 away = vec3(0.0);
    bool particle_collision = false;
    if (a_CollideTime < 0.0 && visible)                                                            // 8
        for (int ty = -u_TexelCollideRange; ty <= u_TexelCollideRange; ++ty)                       // 9
            for (int tx = -u_TexelCollideRange; tx <= u_TexelCollideRange; ++tx) {                 // 10
                ivec2 texel = texel_base + ivec2(tx, ty);                                          // 11
                if ((tx == 0 && ty == 0) || !on_image(texel))                                      // 12
                    continue;
                precise vec3 apart = curr_pos - texelFetch(u_CDTexture, texel, 0).xyz;             // 14
                float len = length(apart);                                                         // 15
                if (u_CollisionRange > len && len < particle_min_length) {                         // 16
                    particle_min_length = len;
                    away = apart;                                                                  // 18
                    particle_collision = true;
                }
            }
    if (particle_collision) {
        out_Speed = a_Speed * u_SpeedFactor;                                                       // 21
        out_Dir = normalize(away);                                                                 // 22
        out_CollideTime = u_CollisionTime;                                                         // 23
        out_Position = a_Position + out_Dir * out_Speed;                                           // 24
    } else {
        precise vec3 temp = a_Dir * a_Speed + u_Gravity * u_Tick;                                  // 26
        out_Dir = normalize(temp);                                                                 // 27
        out_Speed = length(temp);                                                                  // 28
        out_CollideTime = a_CollideTime - u_Tick;                                                  // 29
        out_Position = a_Position + out_Dir * out_Speed * u_Tick;                                  // 30
    }
    trace_particle_min_length = particle_min_length;
}
