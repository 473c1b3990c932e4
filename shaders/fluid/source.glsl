// The depth image that a pass takes its depths from. Needs depth.glsl.

#if SOURCE == SOURCE_DEPTH
uniform sampler2D u_DepthBefore;
#define SOURCE_MAP u_DepthBefore
#else
uniform sampler2D u_SmoothDepthBefore;
#define SOURCE_MAP u_SmoothDepthBefore
#endif

ivec2 image_size() { return textureSize(SOURCE_MAP, 0); }

bool is_inside(ivec2 pixel) {
    return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, image_size()));
}

// What is stored beside a pixel; beyond the image's edge the texel at its edge.
float stored_at(ivec2 pixel, ivec2 offset) {
    ivec2 size = image_size();
#if DEPTH_FETCH == DEPTH_FETCH_LINEAR
    float u = ls_divide(add(add(float(pixel.x), 0.5), float(offset.x)), float(size.x));
    float v = ls_divide(add(add(float(pixel.y), 0.5), float(offset.y)), float(size.y));
    return ls_flush(texture(SOURCE_MAP, vec2(u, v)).x);
#else
    return ls_flush(texelFetch(SOURCE_MAP, clamp(pixel + offset, ivec2(0), size - 1), 0).x);
#endif
}
