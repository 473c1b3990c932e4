#version 430 core
// A buffer for each field, as engines lay particles out that step a million.
layout(local_size_x = 64) in;

layout(std430) readonly buffer PositionsIn { vec4 positions_in[]; };
layout(std430) readonly buffer DirectionsIn { vec4 directions_in[]; };
layout(std430) readonly buffer TimersIn { float timers_in[]; };
layout(std430) writeonly buffer PositionsOut { vec4 positions_out[]; };
layout(std430) writeonly buffer DirectionsOut { vec4 directions_out[]; };
layout(std430) writeonly buffer TimersOut { float timers_out[]; };
layout(std430) buffer Winners { uvec2 winners[]; };
layout(std430) writeonly buffer Wishes { uvec2 wishes[]; };
layout(std140) uniform Frame {
    mat4 view;
    vec3 gravity;
    float tick;
    ivec2 size;
    int reach;
    float range, pause, loss;
    uint count;
} frame;
uniform sampler2D seen;

bool texel_of(vec4 clip, out ivec2 texel) {
    precise vec2 place = (clip.xy / clip.w + 1.0) * 0.5 * vec2(frame.size);
    texel = ivec2(0);
    if (!(place.x >= 0.0 && place.y >= 0.0 && place.x < float(frame.size.x) && place.y < float(frame.size.y)))
        return false;
    texel = ivec2(place);
    return true;
}

// Moves a particle on; `next` is where it is drawn.
void step_particle(inout vec3 position, inout vec3 direction, inout float speed, inout float timer, out vec4 next) {
    precise vec4 clip = frame.view * vec4(position, 1.0);
    ivec2 base;
    precise vec3 away = vec3(0.0);
    precise float nearest = 100000.0;
    if (timer < 0.0 && texel_of(clip, base))
        for (int y = -frame.reach; y <= frame.reach; ++y)
            for (int x = -frame.reach; x <= frame.reach; ++x) {
                ivec2 texel = base + ivec2(x, y);
                if (texel == base || any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, frame.size)))
                    continue;
                vec4 stored = texelFetch(seen, texel, 0);
                precise vec3 apart = position - stored.xyz;
                precise float len = length(apart);
                if (stored.a == 0.0 || len == 0.0 || len >= frame.range || len >= nearest)
                    continue;
                nearest = len;
                away = apart;
            }
    precise vec3 d, p;
    precise float s;
    if (nearest < 100000.0) {
        s = speed * frame.loss;
        d = normalize(away);
        timer = frame.pause;
    } else {
        precise vec3 velocity = direction * speed + frame.gravity * frame.tick;
        s = length(velocity);
        d = normalize(velocity);
        precise float t = timer - frame.tick;
        timer = t;
    }
    precise vec3 path = d * s;
    p = position + path * frame.tick;
    precise vec4 drawn = frame.view * vec4(p, 1.0);
    position = p;
    direction = d;
    speed = s;
    next = drawn;
}

void offer(uint i, vec4 next) {
    precise float depth = (next.z / next.w + 1.0) * 0.5;
    ivec2 texel;
    bool drawn = texel_of(next, texel) && next.w > 0.0 && depth >= 0.0 && depth <= 1.0;
    uint index = uint(texel.y * frame.size.x + texel.x);
    wishes[i] = uvec2(drawn ? index : 0xffffffffu, floatBitsToUint(depth));
    if (drawn)
        atomicMin(winners[index].y, floatBitsToUint(depth));
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= frame.count)
        return;
    vec3 position = positions_in[i].xyz, direction = directions_in[i].xyz;
    float speed = directions_in[i].w, timer = timers_in[i];
    vec4 next;
    step_particle(position, direction, speed, timer, next);
    positions_out[i] = vec4(position, 1.0);
    directions_out[i] = vec4(direction, speed);
    timers_out[i] = timer;
    offer(i, next);
}
