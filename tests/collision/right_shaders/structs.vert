#version 410 core
// The state in a struct, which functions take and give.

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

flat out vec3 out_Position;
out float out_Speed;
out vec3 out_Dir;
out float out_CollideTime;

struct Particle { vec3 pos; vec3 dir; float speed; float timer; };
struct Neighbour { vec3 away; float dist; };

Particle fall(Particle p) {
    vec3 v = p.dir * p.speed + u_Gravity * u_Tick;
    return Particle(p.pos, normalize(v), length(v), p.timer - u_Tick);
}

Particle bounce(Particle p, Neighbour n) {
    return Particle(p.pos, normalize(n.away), p.speed * u_SpeedFactor, u_CollisionTime);
}

void move(inout Particle p) { p.pos += p.dir * p.speed * u_Tick; }

Neighbour look(Particle p, ivec2 at, Neighbour best) {
    vec4 s = texelFetch(u_CDTexture, at, 0);
    Neighbour n = Neighbour(p.pos - s.xyz, length(p.pos - s.xyz));
    bool nearer = s.a != 0.0 && n.dist > 0.0 && n.dist < u_CollisionRange && n.dist < best.dist;
    if (nearer)
        return n;
    return best;
}

void main() {
    Particle p = Particle(a_Position, a_Dir, a_Speed, a_CollideTime);
    Neighbour best = Neighbour(vec3(0.0), 100000.0);
    vec4 clip = u_ProjView * vec4(p.pos, 1.0);
    float x = (clip.x / clip.w + 1.0) * 0.5 * float(u_ClientWidth);
    float y = (clip.y / clip.w + 1.0) * 0.5 * float(u_ClientHeight);
    if (p.timer < 0.0 && x >= 0.0 && x < float(u_ClientWidth) && y >= 0.0 && y < float(u_ClientHeight)) {
        int column = int(x), row = int(y);
        for (int j = row - u_TexelCollideRange; j <= row + u_TexelCollideRange; ++j)
            for (int i = column - u_TexelCollideRange; i <= column + u_TexelCollideRange; ++i)
                if (i >= 0 && j >= 0 && i < u_ClientWidth && j < u_ClientHeight && (i != column || j != row))
                    best = look(p, ivec2(i, j), best);
    }
    if (best.dist < u_CollisionRange)
        p = bounce(p, best);
    else
        p = fall(p);
    move(p);
    out_Position = p.pos;
    out_Dir = p.dir;
    out_Speed = p.speed;
    out_CollideTime = p.timer;
    gl_Position = u_ProjView * vec4(p.pos, 1.0);
}
