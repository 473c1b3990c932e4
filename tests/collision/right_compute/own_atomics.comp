#version 430 core
// No file of ours: vectors of four loaded whole, groups of 32, own atomics.
layout(local_size_x = 32) in;

layout(std430, binding = 0) readonly buffer OldState { vec4 old_state[]; };
layout(std430, binding = 1) writeonly buffer NewState { vec4 new_state[]; };
layout(std430, binding = 2) buffer Winners { uvec2 winners[]; };
layout(std430, binding = 3) writeonly buffer Wishes { uvec2 wishes[]; };

uniform uint u_ParticleCount;
uniform mat4 u_ProjView;
uniform sampler2D u_CDTexture;
uniform int u_ClientWidth, u_ClientHeight, u_TexelCollideRange;
uniform float u_CollisionRange, u_CollisionTime, u_SpeedFactor, u_Tick;
uniform vec3 u_Gravity;

bool texel_of(vec4 clip, out ivec2 texel) {
    precise float x = (clip.x / clip.w + 1.0) * 0.5 * float(u_ClientWidth);
    precise float y = (clip.y / clip.w + 1.0) * 0.5 * float(u_ClientHeight);
    texel = ivec2(0);
    if (!(x >= 0.0 && y >= 0.0 && x < float(u_ClientWidth) && y < float(u_ClientHeight)))
        return false;
    texel = ivec2(int(x), int(y));
    return true;
}

void main() {
    uint i = gl_WorkGroupID.x * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
    if (i < u_ParticleCount) {
        vec4 place = old_state[2u * i], motion = old_state[2u * i + 1u];
        precise vec4 clip = u_ProjView * vec4(place.xyz, 1.0);
        ivec2 base;
        precise vec3 away = vec3(0.0);
        precise float nearest = 100000.0;
        if (motion.w < 0.0 && texel_of(clip, base)) {
            int side = 2 * u_TexelCollideRange + 1;
            for (int k = 0; k < side * side; ++k) {
                ivec2 texel = base + ivec2(k % side, k / side) - u_TexelCollideRange;
                if (texel == base || any(lessThan(texel, ivec2(0))) || texel.x >= u_ClientWidth ||
                    texel.y >= u_ClientHeight)
                    continue;
                vec4 stored = texelFetch(u_CDTexture, texel, 0);
                precise vec3 apart = place.xyz - stored.xyz;
                precise float len = length(apart);
                if (stored.a == 0.0 || len == 0.0 || len >= u_CollisionRange || len >= nearest)
                    continue;
                nearest = len;
                away = apart;
            }
        }
        precise vec3 direction, position;
        precise float speed, time;
        if (nearest < 100000.0) {
            speed = place.w * u_SpeedFactor;
            direction = normalize(away);
            position = place.xyz + direction * speed * u_Tick;
            time = u_CollisionTime;
        } else {
            precise vec3 velocity = motion.xyz * place.w + u_Gravity * u_Tick;
            direction = normalize(velocity);
            speed = length(velocity);
            position = place.xyz + direction * speed * u_Tick;
            time = motion.w - u_Tick;
        }
        new_state[2u * i] = vec4(position, speed);
        new_state[2u * i + 1u] = vec4(direction, time);

        precise vec4 next = u_ProjView * vec4(position, 1.0);
        precise float depth = (next.z / next.w + 1.0) * 0.5;
        ivec2 texel;
        bool drawn = texel_of(next, texel) && next.w > 0.0 && depth >= 0.0 && depth <= 1.0;
        uint index = uint(texel.y * u_ClientWidth + texel.x);
        wishes[i] = uvec2(drawn ? index : 0xffffffffu, floatBitsToUint(depth));
        if (drawn && floatBitsToUint(depth) < winners[index].y)
            atomicMin(winners[index].y, floatBitsToUint(depth));
    }
}
