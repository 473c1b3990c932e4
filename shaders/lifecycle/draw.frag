#version 430 core
// A sprite is its texture, else a round, soft blob; along a ribbon u and v make a pattern that repeats.
in vec4 out_Tint;
flat in uint out_Drawn;
in vec2 out_TexelPlace;

uniform uint u_Blend; // 0: over what is there, 1: added to it, 2: in its place

precise out vec4 o_Color;

#ifdef TEXTURED
uniform sampler2D u_SpriteBefore;
uniform float u_AlphaCut; // below the least alpha that is to be seen

vec4 texel(ivec2 at, ivec2 size) {
    ivec2 inside = clamp(at, ivec2(0), size - 1);
    vec4 color = texelFetch(u_SpriteBefore, inside, 0);
#if UV_OUTSIDE == UV_OUTSIDE_TRANSPARENT
    if (at != inside)
        color.a = 0.0;
#endif
    return color;
}

vec4 sprite(vec2 place) {
    ivec2 size = textureSize(u_SpriteBefore, 0);
    vec2 at = place * vec2(size);
#if FILTER == FILTER_NEAREST
    return texel(ivec2(floor(at)), size);
#else
    vec2 low = floor(at - 0.5), share = at - 0.5 - low;
    ivec2 first = ivec2(low);
    vec4 below = mix(texel(first, size), texel(first + ivec2(1, 0), size), share.x);
    vec4 above = mix(texel(first + ivec2(0, 1), size), texel(first + ivec2(1, 1), size), share.x);
    return mix(below, above, share.y);
#endif
}
#endif

vec4 look() {
    if (out_Drawn == 2u) {
        float along = fract(out_TexelPlace.x);
        return vec4(1.0, 1.0, 1.0, along < 0.5 == out_TexelPlace.y < 0.5 ? 1.0 : 0.35);
    }
#ifdef TEXTURED
    vec4 color = sprite(out_TexelPlace);
    if (color.a <= u_AlphaCut)
        discard;
    return color;
#else
    vec2 from_centre = out_TexelPlace * 2.0 - 1.0;
    float alpha = max(0.0, 1.0 - dot(from_centre, from_centre));
    if (u_Blend == 2u && alpha <= 0.0)
        discard;
    return vec4(1.0, 1.0, 1.0, alpha);
#endif
}

void main() {
    if (out_Drawn == 0u)
        discard;
    vec4 color = look() * out_Tint;
    o_Color = u_Blend == 1u ? vec4(color.rgb * color.a, 0.0) : color;
}
