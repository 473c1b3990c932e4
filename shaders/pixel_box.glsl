// Rectangles of whole pixels, in the exact preset drawn in place of triangles and billboards, whose fragments then
// decide by themselves what is covered. Their sides lie half a pixel from the nearest pixel centre, their z is 0 and
// their w is 1, so that no rasteriser has anything to round. Twin: reference/pixel_box.hpp. Needs arithmetic.glsl.

uniform int u_ClientWidth;
uniform int u_ClientHeight;

// Where clip space lies on the image, pixels.
vec2 window_place(vec2 clip, float w) {
    precise vec2 place = (vec2(ls_divide(clip.x, w), ls_divide(clip.y, w)) + 1.0) * 0.5;
    precise vec2 pixels = place * vec2(u_ClientWidth, u_ClientHeight);
    return pixels;
}

// The pixels, first and end, whose centres lie in the window rectangle low..high or less than 1/16 pixel beside it,
// which is more than `window_place` and the edge functions can be off. Not for NaN.
ivec4 pixel_box(vec2 low, vec2 high) {
    vec2 size = vec2(u_ClientWidth, u_ClientHeight);
    precise vec2 first = ceil(low - 0.5625);
    precise vec2 end = floor(high - 0.4375) + 1.0;
    return ivec4(ivec2(clamp(first, vec2(0.0), size)), ivec2(clamp(end, vec2(0.0), size)));
}

bool is_empty(ivec4 box) { return box.x >= box.z || box.y >= box.w; }

bool is_finite(vec4 v) {
    ivec4 magnitude = floatBitsToInt(v) & 0x7fffffff;
    return all(lessThan(magnitude, ivec4(0x7f800000)));
}

// The pixels a triangle may cover: all, if a part of it lies behind the camera; none, if a corner is not finite.
ivec4 triangle_box(vec4 a, vec4 b, vec4 c) {
    if (!is_finite(a) || !is_finite(b) || !is_finite(c) || max(max(a.w, b.w), c.w) <= 0.0)
        return ivec4(0);
    if (min(min(a.w, b.w), c.w) <= 0.0)
        return ivec4(0, 0, u_ClientWidth, u_ClientHeight);
    vec2 at = window_place(a.xy, a.w);
    vec2 bt = window_place(b.xy, b.w);
    vec2 ct = window_place(c.xy, c.w);
    return pixel_box(min(min(at, bt), ct), max(max(at, bt), ct));
}

// The corners in clip space, as a triangle strip.
vec4 box_corner(ivec4 box, int i) {
    int x = (i & 1) == 0 ? box.x : box.z;
    int y = i < 2 ? box.y : box.w;
    return vec4(ls_divide(float(2 * x - u_ClientWidth), float(u_ClientWidth)),
                ls_divide(float(2 * y - u_ClientHeight), float(u_ClientHeight)), 0.0, 1.0);
}
