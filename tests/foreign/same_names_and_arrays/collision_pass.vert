#version 410 core
// Two structures with members of one name in a block, and numbers in an array.
in vec3 position;
in vec3 heading;
in float pace;
in float cooldown;

uniform mat4 projectionViewMatrix;
uniform sampler2D history;
uniform vec2 resolution;
uniform int kernelRadius;
uniform float limits[3]; // distance, cooldown, bounce
struct T { float dt; };
layout(std140) uniform F { T a; T b; };

uniform vec3 gravity;

precise flat out vec3 nextPosition;
precise out vec3 nextHeading;
precise out float nextPace;
precise out float nextCooldown;
precise gl_Position;

bool search(ivec2 centre, out vec3 away) {
    away = vec3(0.0);
    float closest = 1e5;
    for (int j = -kernelRadius; j <= kernelRadius; j++) {
        for (int i = -kernelRadius; i <= kernelRadius; i++) {
            ivec2 at = centre + ivec2(i, j);
            bool skipped = (i == 0 && j == 0) || min(at.x, at.y) < 0 || at.x >= int(resolution.x) || at.y >= int(resolution.y);
            vec4 sampled = skipped ? vec4(0.0) : texelFetch(history, at, 0);
            if (sampled.a == 0.0)
                continue;
            precise vec3 gap = position - sampled.xyz;
            precise float separation = length(gap);
            if (separation != 0.0 && separation < limits[0] && separation < closest) {
                closest = separation;
                away = gap;
            }
        }
    }
    return closest < 1e5;
}

void main() {
    precise vec4 clip = projectionViewMatrix * vec4(position, 1.0);
    precise vec2 uv = (clip.xy / clip.w + 1.0) * 0.5;
    precise vec2 pixel = uv * resolution;
    vec3 away;
    bool seen = all(greaterThanEqual(pixel, vec2(0.0))) && all(lessThan(pixel, resolution));
    if (cooldown < 0.0 && seen && search(ivec2(pixel), away)) {
        nextHeading = normalize(away);
        nextPace = pace * limits[2];
        nextCooldown = limits[1];
    } else {
        precise vec3 velocity = heading * pace + gravity * (a.dt + b.dt);
        nextHeading = normalize(velocity);
        nextPace = length(velocity);
        nextCooldown = cooldown - (a.dt + b.dt);
    }
    precise vec3 velocity = nextHeading * nextPace;
    nextPosition = position + velocity * (a.dt + b.dt);
    gl_Position = projectionViewMatrix * vec4(nextPosition, 1.0);
}
