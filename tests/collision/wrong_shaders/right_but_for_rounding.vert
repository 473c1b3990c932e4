#version 400 core
// cause: none, in near_ties
// particle system, collision step
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

struct Particle { vec3 pos; vec3 dir; float speed; float timer; };
struct Contact { bool found; vec3 delta; float dist; };

in vec3 a_Position;
in vec3 a_Dir;
in float a_Speed;
in float a_CollideTime;
out vec3 v_Position;
out vec3 v_Dir;
out float v_Speed;
out float v_CollideTime;

Particle load() {
    return Particle(a_Position, a_Dir, a_Speed, a_CollideTime);
}

void store(Particle p) {
    v_Position = p.pos;
    v_Dir = p.dir;
    v_Speed = p.speed;
    v_CollideTime = p.timer;
}

vec4 project(vec3 world) {
    return u_ProjView * vec4(world, 1.0);
}

vec2 toTexels(vec4 clip) {
    vec2 ndc = clip.xy / clip.w;
    vec2 uv = (ndc + vec2(1.0)) * 0.5;
    return uv * vec2(float(u_ClientWidth), float(u_ClientHeight));
}

bool insideImage(ivec2 t) {
    return t.x >= 0 && t.x < u_ClientWidth && t.y >= 0 && t.y < u_ClientHeight;
}

bool occupied(vec4 texel) {
    return texel.w > 0.0;
}

void consider(inout Contact c, vec3 self, vec4 texel) {
    if (!occupied(texel)) return;
    vec3 delta = self - texel.xyz;
    float dist = length(delta);
    if (dist <= 0.0) return;
    if (dist >= u_CollisionRange) return;
    if (dist < c.dist) {
        c.dist = dist;
        c.delta = delta;
        c.found = true;
    }
}

Contact findContact(Particle p, vec2 at) {
    Contact c = Contact(false, vec3(0.0), 100000.0);
    if (!(at.x >= 0.0 && at.y >= 0.0 && at.x < float(u_ClientWidth) && at.y < float(u_ClientHeight)))
        return c;
    ivec2 base = ivec2(at);
    for (int dy = -u_TexelCollideRange; dy <= u_TexelCollideRange; dy++)
        for (int dx = -u_TexelCollideRange; dx <= u_TexelCollideRange; dx++) {
            if (dx == 0 && dy == 0) continue;
            ivec2 t = base + ivec2(dx, dy);
            if (insideImage(t))
                consider(c, p.pos, texelFetch(u_CDTexture, t, 0));
        }
    return c;
}

Particle respond(Particle p, Contact c) {
    p.speed = p.speed * u_SpeedFactor;
    p.dir = normalize(c.delta);
    p.timer = u_CollisionTime;
    p.pos = p.pos + p.dir * p.speed * u_Tick;
    return p;
}

Particle fall(Particle p) {
    vec3 vel = p.dir * p.speed + u_Gravity * u_Tick;
    p.dir = normalize(vel);
    p.speed = length(vel);
    p.timer = p.timer - u_Tick;
    p.pos = p.pos + vel * u_Tick;
    return p;
}

void main() {
    Particle p = load();
    Contact c = Contact(false, vec3(0.0), 0.0);
    if (p.timer < 0.0)
        c = findContact(p, toTexels(project(p.pos)));
    Particle q;
    if (c.found) q = respond(p, c);
    else q = fall(p);
    store(q);
    gl_Position = project(q.pos);
}
