#version 430 core
// One array of floats, eight a particle, and uniforms without a block.
layout(local_size_x = 128) in;

layout(std430) readonly buffer Src { float src[]; };
layout(std430) writeonly buffer Dst { float dst[]; };
layout(std430) buffer Best { uvec2 best[]; };
layout(std430) writeonly buffer Bids { uvec2 bids[]; };

uniform mat4 M;
uniform sampler2D T;
uniform ivec2 S;
uniform int K;
uniform float A, B, C, D;
uniform vec3 F;
uniform uint COUNT;

bool texel_of(vec4 clip, out ivec2 texel) {
    precise vec2 place = (clip.xy / clip.w + 1.0) * 0.5 * vec2(S);
    texel = ivec2(0);
    if (!(place.x >= 0.0 && place.y >= 0.0 && place.x < float(S.x) && place.y < float(S.y)))
        return false;
    texel = ivec2(place);
    return true;
}

// Moves a particle on; `next` is where it is drawn.
void step_particle(inout vec3 position, inout vec3 direction, inout float speed, inout float timer, out vec4 next) {
    precise vec4 clip = M * vec4(position, 1.0);
    ivec2 base;
    precise vec3 away = vec3(0.0);
    precise float nearest = 100000.0;
    if (timer < 0.0 && texel_of(clip, base))
        for (int y = -K; y <= K; ++y)
            for (int x = -K; x <= K; ++x) {
                ivec2 texel = base + ivec2(x, y);
                if (texel == base || any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, S)))
                    continue;
                vec4 stored = texelFetch(T, texel, 0);
                precise vec3 apart = position - stored.xyz;
                precise float len = length(apart);
                if (stored.a == 0.0 || len == 0.0 || len >= A || len >= nearest)
                    continue;
                nearest = len;
                away = apart;
            }
    precise vec3 d, p;
    precise float s;
    if (nearest < 100000.0) {
        s = speed * C;
        d = normalize(away);
        timer = B;
    } else {
        precise vec3 velocity = direction * speed + F * D;
        s = length(velocity);
        d = normalize(velocity);
        precise float t = timer - D;
        timer = t;
    }
    precise vec3 path = d * s;
    p = position + path * D;
    precise vec4 drawn = M * vec4(p, 1.0);
    position = p;
    direction = d;
    speed = s;
    next = drawn;
}

void offer(uint i, vec4 next) {
    precise float depth = (next.z / next.w + 1.0) * 0.5;
    ivec2 texel;
    bool drawn = texel_of(next, texel) && next.w > 0.0 && depth >= 0.0 && depth <= 1.0;
    uint index = uint(texel.y * S.x + texel.x);
    bids[i] = uvec2(drawn ? index : 0xffffffffu, floatBitsToUint(depth));
    if (drawn)
        atomicMin(best[index].y, floatBitsToUint(depth));
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= COUNT)
        return;
    uint o = 8u * i;
    vec3 position = vec3(src[o], src[o + 1u], src[o + 2u]), direction = vec3(src[o + 4u], src[o + 5u], src[o + 6u]);
    float speed = src[o + 3u], timer = src[o + 7u];
    vec4 next;
    step_particle(position, direction, speed, timer, next);
    dst[o] = position.x; dst[o + 1u] = position.y; dst[o + 2u] = position.z; dst[o + 3u] = speed;
    dst[o + 4u] = direction.x; dst[o + 5u] = direction.y; dst[o + 6u] = direction.z; dst[o + 7u] = timer;
    offer(i, next);
}
