#version 450 core
// For glslangValidator -G: locations, a uniform block of its own, and a texture without a location.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 heading;
layout(location = 2) in float pace;
layout(location = 3) in float cooldown;

layout(std140, binding = 3) uniform Camera {
    layout(row_major) mat4 projectionViewMatrix;
    vec2 resolution;
};
layout(binding = 2) uniform sampler2D history;
layout(location = 5) uniform int kernelRadius;
layout(location = 6) uniform float hitDistance;
layout(location = 9) uniform float hitCooldown;
layout(location = 11) uniform float bounce;
layout(location = 12) uniform float delta;
layout(location = 13) uniform vec3 gravity;

layout(location = 0) precise flat out vec3 nextPosition;
layout(location = 2) precise out vec3 nextHeading;
layout(location = 4) precise out float nextPace;
layout(location = 6) precise out float nextCooldown;
out gl_PerVertex { precise vec4 gl_Position; };

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
            if (separation != 0.0 && separation < hitDistance && separation < closest) {
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
        nextPace = pace * bounce;
        nextCooldown = hitCooldown;
    } else {
        precise vec3 velocity = heading * pace + gravity * delta;
        nextHeading = normalize(velocity);
        nextPace = length(velocity);
        nextCooldown = cooldown - delta;
    }
    precise vec3 velocity = nextHeading * nextPace;
    nextPosition = position + velocity * delta;
    gl_Position = projectionViewMatrix * vec4(nextPosition, 1.0);
}
