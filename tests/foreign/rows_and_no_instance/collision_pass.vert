#version 440 core
// A block in the driver's own layout, its matrix by rows, members by their bare names; unsigned texels.
layout(row_major) uniform PerFrame {
    float range_, rest_, loss_;
    mat4 to_clip;
    int around;
    vec3 pull;
    ivec2 extent;
    float seconds;
};
uniform sampler2D earlier;

in vec3 p0; in vec3 d0; in float s0; in float t0;
precise flat out vec3 p1;
precise out vec3 d1;
precise out float s1;
precise out float t1;
precise gl_Position;

float best = 100000.0;
vec3 gap = vec3(0.0);

void look(uvec2 texel) {
    if (any(greaterThanEqual(texel, uvec2(extent)))) // below 0 is far above, too
        return;
    vec4 held = texelFetch(earlier, ivec2(texel), 0);
    precise vec3 apart = p0 - held.xyz;
    precise float len = length(apart);
    if (held.a != 0.0 && len != 0.0 && len < range_ && len < best) {
        best = len;
        gap = apart;
    }
}

void main() {
    precise vec4 clip = to_clip * vec4(p0, 1.0);
    precise vec2 place = (clip.xy / clip.w + 1.0) * 0.5 * vec2(extent);
    if (t0 < 0.0 && place.x >= 0.0 && place.y >= 0.0 && place.x < float(extent.x) && place.y < float(extent.y))
        for (int y = -around; y <= around; ++y)
            for (int x = -around; x <= around; ++x)
                if (x != 0 || y != 0)
                    look(uvec2(ivec2(place) + ivec2(x, y)));
    precise vec3 v = d0 * s0 + pull * seconds;
    bool hits = best < 100000.0;
    precise float loss = s0 * loss_;
    precise float later = t0 - seconds;
    d1 = normalize(hits ? gap : v);
    s1 = hits ? loss : length(v);
    t1 = hits ? rest_ : later;
    precise vec3 path = d1 * s1;
    p1 = p0 + path * seconds;
    gl_Position = to_clip * vec4(p1, 1.0);
}
