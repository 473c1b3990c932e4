#version 430
// Heat spreads to the four neighbours; walls let none through. A source wanders along the lowest row.
layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D before;
layout(r32f) writeonly uniform image2D after;
uniform usampler2D walls;
uniform float rate, source;

float at(ivec2 p, float own) {
    p = clamp(p, ivec2(0), textureSize(before, 0) - 1);
    return texelFetch(walls, p, 0).r == 0u ? own : texelFetch(before, p, 0).r;
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, textureSize(before, 0))))
        return;
    float own = texelFetch(before, p, 0).r;
    float sum = at(p + ivec2(1, 0), own) + at(p - ivec2(1, 0), own) + at(p + ivec2(0, 1), own) + at(p - ivec2(0, 1), own);
    float heat = own + rate * (sum - 4.0 * own);
    if (p.y == 0 && abs(float(p.x) - source) < 1.0)
        heat = 1.0;
    imageStore(after, p, vec4(heat));
}
