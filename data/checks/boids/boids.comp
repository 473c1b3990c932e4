#version 430
// A flock: each boid steers by those that it sees.
layout(local_size_x = 64) in;

struct Boid {
    vec2 position;
    vec2 velocity;
};
layout(std430, binding = 0) readonly buffer BoidsIn { Boid before[]; };
layout(std430, binding = 1) writeonly buffer BoidsOut { Boid after[]; };

uniform float dt;
uniform float sight;
uniform float closest;
uniform vec3 weights; // cohesion, alignment, separation

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(before.length()))
        return;
    Boid me = before[i];
    vec2 centre = vec2(0.0), heading = vec2(0.0), away = vec2(0.0);
    int seen = 0;
    for (int k = 0; k < before.length(); ++k) {
        if (k == int(i))
            continue;
        vec2 to = before[k].position - me.position;
        float far = length(to);
        if (far > sight)
            continue;
        centre += before[k].position;
        heading += before[k].velocity;
        if (far < closest)
            away -= to;
        ++seen;
    }
    vec2 velocity = me.velocity;
    if (seen > 0) {
        vec2 cohesion = centre / float(seen) - me.position;
        vec2 alignment = heading / float(seen) - me.velocity;
        velocity += dt * (weights.x * cohesion + weights.y * alignment + weights.z * away);
    }
    vec2 position = me.position + dt * velocity;
    if (abs(position.x) > 1.0)
        velocity.x = -velocity.x;
    if (abs(position.y) > 1.0)
        velocity.y = -velocity.y;
    after[i].position = clamp(position, -1.0, 1.0);
    after[i].velocity = velocity;
}
