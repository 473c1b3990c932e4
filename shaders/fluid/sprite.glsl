// A particle as a disc on the image. Needs rounding.glsl and pixel_box.glsl.

uniform mat4 mView;
uniform mat4 projection;
uniform float pointRadius; // m
uniform float pointScale;  // pixels, of a length as far away as it is long
uniform float u_Near;

struct Sprite {
    bool drawn;
    vec3 centre; // view space
    vec2 window; // the centre, pixels
    float side;  // pixels
};

float ahead_of(Sprite sprite) { return neg(sprite.centre.z); }

Sprite sprite_of(vec3 position) {
    Sprite sprite = Sprite(is_finite(vec4(position, 0.0)), ls_transform(mView, position).xyz, vec2(0.0), 0.0);
    float w = ahead_of(sprite);
    sprite.drawn = sprite.drawn && w > u_Near;
#if POINT_SIZE == POINT_SIZE_DISTANCE
    float away = ls_length(sprite.centre);
#else
    float away = w;
#endif
    sprite.side = ls_divide(mul(pointScale, pointRadius), away);
    vec2 place = vec2(ls_divide(mul(projection[0][0], sprite.centre.x), w),
                      ls_divide(mul(projection[1][1], sprite.centre.y), w));
    sprite.window = vec2(mul(mul(add(place.x, 1.0), 0.5), float(u_ClientWidth)),
                         mul(mul(add(place.y, 1.0), 0.5), float(u_ClientHeight)));
    return sprite;
}

float half_of(Sprite sprite) { return mul(0.5, sprite.side); }

// A pixel's squared distance from the centre of a disc of radius 1.
float disc_place(ivec2 pixel, vec2 window, float half_side) {
    float nx = ls_divide(sub(add(float(pixel.x), 0.5), window.x), half_side);
    float ny = ls_divide(sub(add(float(pixel.y), 0.5), window.y), half_side);
    return add(mul(nx, nx), mul(ny, ny));
}

#if SPRITE == SPRITE_POINTS
ivec4 disc_box(Sprite sprite) { return ivec4(0, 0, u_ClientWidth, u_ClientHeight); }
#else
// The pixels whose centres may lie on the disc. It was rounded a few times.
ivec4 disc_box(Sprite sprite) {
    vec2 reach = vec2(half_of(sprite)) + (abs(sprite.window) + half_of(sprite)) / 1048576.0;
    return pixel_box(sprite.window - reach, sprite.window + reach);
}
#endif
