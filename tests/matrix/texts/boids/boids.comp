#version 430
// The same flock, written as plainly as can be: component by component, one invocation a group.
layout(local_size_x = 1) in;

struct Boid {
    vec2 position;
    vec2 velocity;
};
layout(std430) buffer BoidsIn { Boid before[]; };
layout(std430) buffer BoidsOut { Boid after[]; };

uniform float dt, sight, closest;
uniform vec3 weights;

void main() {
    int i = int(gl_GlobalInvocationID.x);
    int seen = 0;
    float centre_x = 0.0, centre_y = 0.0, heading_x = 0.0, heading_y = 0.0, away_x = 0.0, away_y = 0.0;
    for (int k = 0; k < before.length(); ++k) {
        float x = before[k].position.x - before[i].position.x, y = before[k].position.y - before[i].position.y;
        float far = sqrt(x * x + y * y);
        if (k != i && far <= sight) {
            seen = seen + 1;
            centre_x = centre_x + before[k].position.x;
            centre_y = centre_y + before[k].position.y;
            heading_x = heading_x + before[k].velocity.x;
            heading_y = heading_y + before[k].velocity.y;
            if (far < 2.0 * closest) {
                away_x = away_x - x;
                away_y = away_y - y;
            }
        }
    }
    float vx = before[i].velocity.x, vy = before[i].velocity.y;
    if (seen > 0) {
        float n = float(seen);
        vx = vx + dt * (weights.x * (centre_x / n - before[i].position.x) +
                        weights.y * (heading_x / n - before[i].velocity.x) + weights.z * away_x);
        vy = vy + dt * (weights.x * (centre_y / n - before[i].position.y) +
                        weights.y * (heading_y / n - before[i].velocity.y) + weights.z * away_y);
    }
    float x = before[i].position.x + dt * vx, y = before[i].position.y + dt * vy;
    if (x > 1.0 || x < -1.0)
        vx = -vx;
    if (y > 1.0 || y < -1.0)
        vy = -vy;
    after[i].position = vec2(min(max(x, -1.0), 1.0), min(max(y, -1.0), 1.0));
    after[i].velocity = vec2(vx, vy);
}
