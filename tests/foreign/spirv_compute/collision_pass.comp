#version 450 core
// For glslangValidator -G: structures with padding behind a count, at binding points of its own.
layout(local_size_x = 32) in;

struct Mote {
    vec3 where;
    float pad;
    vec3 heading;
    float pace;
    float rest;
};
layout(std140, binding = 4) readonly buffer Old { uint many; Mote motes[]; } old;
layout(std140, binding = 1) writeonly buffer New { Mote motes[]; } made;
layout(std430, binding = 0) buffer Held { uvec2 held[]; };
layout(std430, binding = 2) writeonly buffer Asked { uvec2 asked[]; };
layout(std140, binding = 1) uniform Frame {
    mat4 view;
    vec3 gravity;
    float tick;
    ivec2 size;
    int reach;
    float range, pause, loss;
    uint count;
} frame;
layout(binding = 0) uniform sampler2D seen;

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
        d = away * inversesqrt(dot(away, away));
        timer = frame.pause;
    } else {
        precise vec3 velocity = direction * speed + frame.gravity * frame.tick;
        s = length(velocity);
        d = velocity * inversesqrt(dot(velocity, velocity));
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
    asked[i] = uvec2(drawn ? index : 0xffffffffu, floatBitsToUint(depth));
    if (drawn)
        atomicMin(held[index].y, floatBitsToUint(depth));
}

void main() {
    uint i = gl_WorkGroupID.x * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (i >= old.many)
        return;
    Mote m = old.motes[i];
    vec4 next;
    step_particle(m.where, m.heading, m.pace, m.rest, next);
    made.motes[i] = m;
    offer(i, next);
}
