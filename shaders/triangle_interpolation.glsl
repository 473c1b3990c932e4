// Coverage and perspective-correct interpolation of a triangle in homogeneous coordinates (Olano and Greer, "Triangle
// scan conversion using 2D homogeneous coordinates", 1997), at pixel centres and in a written order of operations, so
// that nothing depends on the driver's interpolator, nor, in the exact preset or where COVERAGE_BY_FRAGMENT is defined,
// on its rasteriser.
// Twin: reference/triangle_interpolation.hpp. Needs arithmetic.glsl and clamp_to.glsl.

struct TriangleEdges {
    float first, second, third; // edge functions of the sides opposite to the corners: their shares times `sum`
    float sum;
};

vec2 flushed(vec2 v) { return vec2(ls_flush(v.x), ls_flush(v.y)); }

// a x b. Swapping a and b changes the sign and no other bit, and the sign is right or the result 0: rounding keeps the
// order of the two products.
float edge_function(vec2 a, vec2 b) {
    precise vec2 products = vec2(a.x * b.y, b.x * a.y);
    products = flushed(products);
    precise float difference = products.x - products.y;
    return ls_flush(difference);
}

// At the centre of `pixel` of an image of `size`. Corners are taken relative to the centre, in half pixels times w:
// what cancels cancels before anything is multiplied, which keeps triangles of a pixel's size accurate.
TriangleEdges triangle_edges(vec4 clip[3], ivec2 pixel, ivec2 size) {
    precise vec2 extent = vec2(size);
    precise vec2 centre = vec2(2 * pixel + 1 - size);
    precise vec2 r0 = clip[0].xy * extent - centre * clip[0].w;
    precise vec2 r1 = clip[1].xy * extent - centre * clip[1].w;
    precise vec2 r2 = clip[2].xy * extent - centre * clip[2].w;
    r0 = flushed(r0);
    r1 = flushed(r1);
    r2 = flushed(r2);
    TriangleEdges edges;
    edges.first = edge_function(r1, r2);
    edges.second = edge_function(r2, r0);
    edges.third = edge_function(r0, r1);
    precise float sum = (edges.first + edges.second) + edges.third;
    edges.sum = ls_flush(sum);
    return edges;
}

// Shares of the second and third corner; the first has the rest.
vec2 corner_shares(TriangleEdges edges) {
    if (!(edges.sum < 0.0) && !(edges.sum > 0.0))
        return vec2(0.0);
    precise float second_share = clamp_to(ls_divide(edges.second, edges.sum), 1.0);
    precise float rest = 1.0 - second_share;
    return vec2(second_share, clamp_to(ls_divide(edges.third, edges.sum), rest));
}

float interpolate(float first, float second, float third, vec2 shares) {
    precise vec2 sides = vec2(second - first, third - first);
    precise vec2 parts = shares * flushed(sides);
    parts = flushed(parts);
    precise float nearly = first + parts.x;
    precise float value = ls_flush(nearly) + parts.y;
    return ls_flush(value);
}

vec3 interpolate(vec3 corner[3], vec2 shares) {
    return vec3(interpolate(corner[0].x, corner[1].x, corner[2].x, shares),
                interpolate(corner[0].y, corner[1].y, corner[2].y, shares),
                interpolate(corner[0].z, corner[1].z, corner[2].z, shares));
}

struct TriangleFragment {
    bool covered;
    vec2 shares;
    float depth; // window, 0..1
};

#if ARITHMETIC == ARITHMETIC_EXACT || defined(COVERAGE_BY_FRAGMENT)

// A closed triangle, so that triangles that share a side leave no gap: a centre on the side belongs to both, and the
// depth test decides. Nothing that is seen edge-on, behind the camera or beyond the near or far plane.
TriangleFragment triangle_fragment(vec4 clip[3], ivec2 pixel, ivec2 size) {
    TriangleEdges edges = triangle_edges(clip, pixel, size);
    vec2 shares = corner_shares(edges);
    float clip_z = interpolate(clip[0].z, clip[1].z, clip[2].z, shares);
    float clip_w = interpolate(clip[0].w, clip[1].w, clip[2].w, shares);
    precise float depth = ls_divide(clip_z, clip_w) * 0.5 + 0.5;

    int sum = floatBitsToInt(edges.sum);
    bool finite = sum != 0 && (sum & 0x7fffffff) < 0x7f800000;
    bool counterclockwise = edges.first >= 0.0 && edges.second >= 0.0 && edges.third >= 0.0;
    bool clockwise = edges.first <= 0.0 && edges.second <= 0.0 && edges.third <= 0.0;
    bool in_front = floatBitsToInt(clip_w) > 0 && in_unit_interval(depth);
    return TriangleFragment(finite && (counterclockwise || clockwise) && in_front, shares, depth);
}

#else

// What the rasteriser found covered. Shares and depth are clamped: a centre that is covered only because corners were
// snapped gets the nearest share inside.
TriangleFragment triangle_fragment(vec4 clip[3], ivec2 pixel, ivec2 size) {
    vec2 shares = corner_shares(triangle_edges(clip, pixel, size));
    float clip_z = interpolate(clip[0].z, clip[1].z, clip[2].z, shares);
    float clip_w = interpolate(clip[0].w, clip[1].w, clip[2].w, shares);
    precise float depth = ls_divide(clip_z, clip_w) * 0.5 + 0.5;
    return TriangleFragment(true, shares, clamp_to(depth, 1.0));
}

#endif
