// Where a clip-space position lies on the image of u_ClientWidth x u_ClientHeight texels, and where the point that is
// drawn for it is put. Line numbers are the listing's (thesis, Fig. 3-3). Needs arithmetic.glsl.

#include "trace.glsl"

uniform int u_ClientWidth;
uniform int u_ClientHeight;

// Lines 2 and 3, before the cast to integers: where clip space lies on the image, in texels; `divided` is clip.xy / clip.w.
vec2 image_position(vec4 clip, vec2 divided) {
    precise vec2 ndc = clip.xy;
#if PERSPECTIVE_DIVIDE == PERSPECTIVE_DIVIDE_ON
    ndc = divided;
#endif
    precise vec2 tex_coord = (ndc + vec2(1.0)) * 0.5;
    precise vec2 scaled = vec2(tex_coord.x * float(u_ClientWidth), tex_coord.y * float(u_ClientHeight));
    TRACE(last_clip, clip);
    TRACE(last_ndc, ndc);
    TRACE(last_texture_coordinate, tex_coord);
    TRACE(last_image_position, scaled);
    return scaled;
}

vec2 image_position(vec4 clip) {
    return image_position(clip, vec2(ls_divide(clip.x, clip.w), ls_divide(clip.y, clip.w)));
}

// The same texel, where only that is asked. A division of `exact` is a long sequence; the driver's own, 2.5 units off in the
// last place at most, does where no border between texels is near: 2^-20 of image and position outweighs all roundings.
vec2 position_in_texel(vec4 clip) {
#if ARITHMETIC == ARITHMETIC_EXACT && !defined(LOCKSTEP_TRACE)
    vec2 rough = image_position(clip, clip.xy / clip.w);
    vec2 margin = (abs(rough) + vec2(u_ClientWidth, u_ClientHeight)) * (1.0 / 1048576.0);
    if (all(greaterThan(abs(rough - floor(rough + 0.5)), margin)) && abs(clip.w) < 1e30)
        return rough;
#endif
    return image_position(clip);
}

// Line 4. False where the texel lies outside the image, or nowhere: the cast is only made where it is defined.
bool base_texel(vec2 scaled, out ivec2 texel) {
    texel = ivec2(0);
    vec2 size = vec2(u_ClientWidth, u_ClientHeight);
#if BASE_TEXEL == BASE_TEXEL_TRUNCATE
    bool inside = scaled.x > -1.0 && scaled.y > -1.0 && scaled.x < size.x && scaled.y < size.y;
#else
    bool inside = scaled.x >= 0.0 && scaled.y >= 0.0 && scaled.x < size.x && scaled.y < size.y;
#endif
    if (inside)
        texel = ivec2(scaled);
    return inside;
}

// The exact preset leaves the rasteriser nothing to round: the point stands on the centre of the texel that the next
// frame will compute for it, at w = 1, its depth on a grid of 2^-24, which survives z * 0.5 + 0.5 unchanged. Points
// outside the view volume are put outside it.
vec4 texel_centre(vec4 clip) {
    ivec2 texel;
    bool visible = base_texel(image_position(clip), texel);
    precise float depth = (ls_divide(clip.z, clip.w) + 1.0) * 0.5;
    if (!visible || !(clip.w > 0.0) || !(depth >= 0.0) || !(depth <= 1.0))
        return vec4(0.0, 0.0, 2.0, 1.0);
    precise vec2 centre = vec2(2 * texel + 1) * vec2(ls_divide(1.0, float(u_ClientWidth)),
                                                     ls_divide(1.0, float(u_ClientHeight))) - 1.0;
    precise float on_grid = floor(depth * 16777216.0) * (1.0 / 16777216.0);
    precise float z = 2.0 * on_grid - 1.0;
    return vec4(centre, z, 1.0);
}

// The gl_Position of a size-1 point.
vec4 point_position(vec4 clip) {
#if ARITHMETIC == ARITHMETIC_EXACT
    return texel_centre(clip);
#else
    return clip;
#endif
}
