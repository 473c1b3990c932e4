// What is read of both textures at a place in the grid, in voxels. Twin: reference/lights/sampling.hpp. Needs
// rounding.glsl.

uniform sampler3D u_LightColorBefore;
uniform sampler3D u_LightDirectionBefore;
uniform ivec3 u_GridSize;

struct Sample {
    vec4 colour;
    vec4 direction;
};

vec4 mul(vec4 v, float s) { return vec4(mul(v.xyz, s), mul(v.w, s)); }
vec4 add(vec4 a, vec4 b) { return vec4(add(a.xyz, b.xyz), add(a.w, b.w)); }
Sample mul(Sample a, float s) { return Sample(mul(a.colour, s), mul(a.direction, s)); }
Sample add(Sample a, Sample b) { return Sample(add(a.colour, b.colour), add(a.direction, b.direction)); }

Sample texel_at(ivec3 at) {
    ivec3 inside = clamp(at, ivec3(0), u_GridSize - 1);
#if OUTSIDE == OUTSIDE_BLACK
    if (at != inside)
        return Sample(vec4(0.0), vec4(0.0));
#endif
    vec4 colour = texelFetch(u_LightColorBefore, inside, 0);
    vec4 direction = texelFetch(u_LightDirectionBefore, inside, 0);
    return Sample(vec4(ls_flush3(colour.xyz), ls_flush(colour.w)),
                  vec4(ls_flush3(direction.xyz), ls_flush(direction.w)));
}

#if INTERPOLATION == INTERPOLATION_NEAREST

Sample sample_at(vec3 u) { return texel_at(ivec3(floor(u))); }

#elif INTERPOLATION == INTERPOLATION_TRILINEAR_HW

Sample sample_at(vec3 u) {
    vec3 at = u / vec3(u_GridSize);
    return Sample(texture(u_LightColorBefore, at), texture(u_LightDirectionBefore, at));
}

#else

// The texel before a place, and how far the place is behind its point.
ivec3 base_of(vec3 u, out vec3 f) {
    vec3 t = sub(u, vec3(0.5));
    vec3 base = floor(t);
    f = sub(t, base);
#if INTERPOLATION == INTERPOLATION_TRILINEAR8
    f = mul(floor(add(mul(f, 256.0), vec3(0.5))), 1.0 / 256.0);
#endif
    return ivec3(base);
}

#if INTERPOLATION == INTERPOLATION_TRICUBIC

vec4 weights(float f) {
    float ff = mul(f, f);
    return vec4(mul(f, add(-0.5, mul(f, sub(1.0, mul(f, 0.5))))),
                add(1.0, mul(ff, add(-2.5, mul(1.5, f)))),
                mul(f, add(0.5, mul(f, sub(2.0, mul(1.5, f))))),
                mul(ff, add(-0.5, mul(0.5, f))));
}

Sample sample_at(vec3 u) {
    vec3 f;
    ivec3 base = base_of(u, f) - 1;
    vec4 wx = weights(f.x);
    vec4 wy = weights(f.y);
    vec4 wz = weights(f.z);
    Sample sum;
    for (int k = 0; k < 4; ++k) {
        Sample plane;
        for (int j = 0; j < 4; ++j) {
            Sample row;
            for (int i = 0; i < 4; ++i) {
                Sample one = mul(texel_at(base + ivec3(i, j, k)), wx[i]);
                if (i == 0)
                    row = one;
                else
                    row = add(row, one);
            }
            row = mul(row, wy[j]);
            if (j == 0)
                plane = row;
            else
                plane = add(plane, row);
        }
        plane = mul(plane, wz[k]);
        if (k == 0)
            sum = plane;
        else
            sum = add(sum, plane);
    }
    sum.colour.x = sum.colour.x > 0.0 ? sum.colour.x : 0.0;
    sum.colour.y = sum.colour.y > 0.0 ? sum.colour.y : 0.0;
    sum.colour.z = sum.colour.z > 0.0 ? sum.colour.z : 0.0;
    return sum;
}

#else

Sample lerp(Sample a, Sample b, float f) { return add(mul(a, sub(1.0, f)), mul(b, f)); }

Sample sample_at(vec3 u) {
    vec3 f;
    ivec3 base = base_of(u, f);
    Sample along_y[2];
    for (int k = 0; k < 2; ++k) {
        Sample along_x[2];
        for (int j = 0; j < 2; ++j)
            along_x[j] = lerp(texel_at(base + ivec3(0, j, k)), texel_at(base + ivec3(1, j, k)), f.x);
        along_y[k] = lerp(along_x[0], along_x[1], f.y);
    }
    return lerp(along_y[0], along_y[1], f.z);
}

#endif
#endif

// The mean over S^3 points in a voxel around u.
Sample mean_at(vec3 u) {
#if SUPERSAMPLE == SUPERSAMPLE_1
    return sample_at(u);
#else
#if SUPERSAMPLE == SUPERSAMPLE_2
    const int count = 2;
#else
    const int count = 4;
#endif
    const float side = float(count);
    Sample sum;
    for (int k = 0; k < count * count * count; ++k) {
        ivec3 i = ivec3(k % count, k / count % count, k / (count * count));
        vec3 offset = (vec3(i) + 0.5) / side - 0.5;
        Sample one = sample_at(add(u, offset));
        if (k == 0)
            sum = one;
        else
            sum = add(sum, one);
    }
    return mul(sum, 1.0 / (side * side * side));
#endif
}
