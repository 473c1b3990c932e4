// Perspective-correct interpolation over a triangle in homogeneous coordinates (Olano and Greer, "Triangle scan
// conversion using 2D homogeneous coordinates", 1997), at pixel centres and in a written order of operations, so that
// nothing depends on the driver's interpolator. Twin: reference/triangle_interpolation.hpp. Needs arithmetic.glsl
// and clamp_to.glsl.

// Shares of the second and third corner at the centre of `pixel` of an image of `size`; the first corner has the rest.
// Corners are taken relative to the centre, in half pixels times w: what cancels cancels before anything is
// multiplied, which keeps triangles of a pixel's size accurate.
vec2 corner_shares(vec4 clip[3], ivec2 pixel, ivec2 size) {
    precise vec2 extent = vec2(size);
    precise vec2 centre = vec2(2 * pixel + 1 - size);
    precise vec2 r0 = clip[0].xy * extent - centre * clip[0].w;
    precise vec2 r1 = clip[1].xy * extent - centre * clip[1].w;
    precise vec2 r2 = clip[2].xy * extent - centre * clip[2].w;
    precise float first = r1.x * r2.y - r2.x * r1.y;
    precise float second = r2.x * r0.y - r0.x * r2.y;
    precise float third = r0.x * r1.y - r1.x * r0.y;
    precise float sum = (first + second) + third;
    if (!(sum < 0.0) && !(sum > 0.0))
        return vec2(0.0);
    precise float second_share = clamp_to(ls_divide(second, sum), 1.0);
    precise float rest = 1.0 - second_share;
    return vec2(second_share, clamp_to(ls_divide(third, sum), rest));
}

float interpolate(float first, float second, float third, vec2 shares) {
    precise float value = (first + shares.x * (second - first)) + shares.y * (third - first);
    return value;
}

vec3 interpolate(vec3 corner[3], vec2 shares) {
    return vec3(interpolate(corner[0].x, corner[1].x, corner[2].x, shares),
                interpolate(corner[0].y, corner[1].y, corner[2].y, shares),
                interpolate(corner[0].z, corner[1].z, corner[2].z, shares));
}

// Window depth, 0..1.
float interpolated_depth(vec4 clip[3], vec2 shares) {
    float clip_z = interpolate(clip[0].z, clip[1].z, clip[2].z, shares);
    float clip_w = interpolate(clip[0].w, clip[1].w, clip[2].w, shares);
    precise float depth = ls_divide(clip_z, clip_w) * 0.5 + 0.5;
    return clamp_to(depth, 1.0);
}
