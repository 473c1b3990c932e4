#version 400 core
// Width and height as floats, the sign of gravity by a constant of its own, and a geometry stage of its own.
in vec3 Pos; in vec3 Vel; in float Mag; in float Timer;
uniform mat4 MVP; uniform sampler2D Grid; uniform float W; uniform float H;
uniform int N; uniform float R; uniform float T; uniform float E; uniform float h; uniform vec3 G; uniform float One;
precise out vec3 VPos; precise out vec3 VVel; precise out float VMag; precise out float VTimer;
precise gl_Position;

void main() {
    precise vec4 c = MVP * vec4(Pos, One);
    precise float x = (c.x / c.w + One) * 0.5 * W, y = (c.y / c.w + One) * 0.5 * H;
    float m = 100000.0;
    precise vec3 d = vec3(0.0);
    if (Timer < 0.0 && x >= 0.0 && y >= 0.0 && x < W && y < H) {
        int bx = int(x), by = int(y);
        int j = -N;
        while (j <= N) {
            int i = -N;
            while (i <= N) {
                int tx = bx + i, ty = by + j;
                if (!(i == 0 && j == 0) && tx >= 0 && ty >= 0 && tx < int(W) && ty < int(H)) {
                    vec4 q = texelFetch(Grid, ivec2(tx, ty), 0);
                    precise vec3 r = Pos - q.xyz;
                    precise float l = length(r);
                    if (q.a != 0.0 && l != 0.0 && l < R && l < m) { m = l; d = r; }
                }
                ++i;
            }
            ++j;
        }
    }
    if (m < 100000.0) {
        VMag = Mag * E;
        VVel = normalize(d);
        VTimer = T;
    } else {
        precise vec3 v = Vel * Mag + G * h;
        VMag = length(v);
        VVel = normalize(v);
        VTimer = Timer - h;
    }
    precise vec3 u = VVel * VMag;
    VPos = Pos + u * h;
    gl_Position = MVP * vec4(VPos, One);
}
