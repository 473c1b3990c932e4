#version 430
// The same, neighbour by neighbour.
layout(local_size_x = 1, local_size_y = 1) in;
uniform sampler2D before;
layout(r32f) writeonly uniform image2D after;
uniform usampler2D walls;
uniform float rate, source;

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy), size = textureSize(before, 0);
    float own = texelFetch(before, p, 0).r;
    const ivec2 ways[4] = ivec2[4](ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1));
    float sum = 0.0;
    for (int k = 0; k < 4; ++k) {
        ivec2 q = p + ways[k];
        q = ivec2(min(max(q.x, 0), size.x - 1), min(max(q.y, 0), size.y - 1));
        sum = sum + (texelFetch(walls, q, 0).r == 0u ? own : texelFetch(before, q, 0).r);
    }
    float heat = own + rate * (sum - 4.0 * own);
    float x = float(p.x);
    if (p.y == 0 && x - source < 1.0 && source - x < 1.0)
        heat = 1.0;
    imageStore(after, p, vec4(heat));
}
