#version 330 core
// cause: collide_time_counts_on_at_hit + direction_towards_neighbour, in crowd
#extension GL_ARB_gpu_shader5 : require

// Particle step, split into small functions.
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

struct Particle { vec3 pos; vec3 dir; float speed; float timer; };
struct Contact { bool found; vec3 offset; float dist; };

vec4 toClip(vec3 p) {
    precise vec4 c = u_ProjView * vec4(p, 1.0);
    return c;
}

bool locate(vec4 clip, out ivec2 cell) {
    precise vec2 ndc = clip.xy / clip.w;
    precise vec2 st = (ndc + vec2(1.0)) * 0.5;
    precise vec2 px = st * vec2(float(u_ClientWidth), float(u_ClientHeight));
    cell = ivec2(0);
    if (!(px.x >= 0.0 && px.y >= 0.0)) return false;
    if (!(px.x < float(u_ClientWidth) && px.y < float(u_ClientHeight))) return false;
    cell = ivec2(floor(px));
    return true;
}

bool isInside(ivec2 c) {
    return c.x >= 0 && c.x < u_ClientWidth && c.y >= 0 && c.y < u_ClientHeight;
}

bool readCell(ivec2 c, out vec3 p) {
    vec4 t = texelFetch(u_CDTexture, c, 0);
    p = t.xyz;
    return t.w != 0.0;
}

float metric(vec3 d) {
    return length(d);
}

void consider(vec3 own, vec3 other, inout Contact best) {
    precise vec3 d = other - own;
    float dist = metric(d);
    if (dist == 0.0) return;
    if (dist >= u_CollisionRange) return;
    if (dist < best.dist) {
        best.found = true;
        best.offset = d;
        best.dist = dist;
    }
}

Contact findContact(Particle self, ivec2 cell) {
    Contact best = Contact(false, vec3(0.0), 100000.0);
    int r = u_TexelCollideRange;
    for (int dy = -r; dy <= r; dy++) {
        for (int dx = -r; dx <= r; dx++) {
            if (dx == 0 && dy == 0) continue;
            ivec2 c = cell + ivec2(dx, dy);
            if (!isInside(c)) continue;
            vec3 other;
            if (readCell(c, other)) consider(self.pos, other, best);
        }
    }
    return best;
}

Particle bounce(Particle p, Contact hit) {
    Particle q;
    precise float speed = p.speed * u_SpeedFactor;
    precise vec3 dir = normalize(hit.offset);
    precise vec3 move = dir * speed;
    move = move * u_Tick;
    precise vec3 pos = p.pos + move;
    q.pos = pos;
    q.dir = dir;
    q.speed = speed;
    precise float timer = p.timer - u_Tick;
    q.timer = timer;
    return q;
}

Particle fly(Particle p) {
    Particle q;
    precise vec3 v = p.dir * p.speed;
    precise vec3 dv = u_Gravity * u_Tick;
    v = v + dv;
    precise vec3 dir = normalize(v);
    precise float speed = length(v);
    precise vec3 move = dir * speed;
    move = move * u_Tick;
    precise vec3 pos = p.pos + move;
    precise float timer = p.timer - u_Tick;
    q.pos = pos;
    q.dir = dir;
    q.speed = speed;
    q.timer = timer;
    return q;
}

void publish(Particle q) {
    v_Position = q.pos;
    v_Dir = q.dir;
    v_Speed = q.speed;
    v_CollideTime = q.timer;
    gl_Position = toClip(q.pos);
}

void main() {
    Particle self = Particle(a_Position, a_Dir, a_Speed, a_CollideTime);
    ivec2 cell;
    bool onScreen = locate(toClip(self.pos), cell);
    Contact hit = Contact(false, vec3(0.0), 0.0);
    if (self.timer < 0.0 && onScreen) hit = findContact(self, cell);
    if (hit.found) publish(bounce(self, hit));
    else publish(fly(self));
}
