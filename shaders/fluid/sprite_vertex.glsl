// Draws a particle's sprite: a point, or the rectangle of pixels that it may cover. Needs sprite.glsl and depth.glsl.

in vec4 a_Position;

precise flat out vec3 v_Centre; // view space
precise flat out vec2 v_Window; // pixels
precise flat out float v_Half;
precise gl_Position;

vec4 place_of(Sprite sprite, ivec4 box) {
#if SPRITE == SPRITE_POINTS
    vec3 c = sprite.centre;
    return vec4(mul(projection[0][0], c.x), mul(projection[1][1], c.y),
                add(mul(u_DepthCoefficients.x, c.z), u_DepthCoefficients.y), ahead_of(sprite));
#else
    const int corner[6] = int[6](0, 1, 2, 2, 1, 3);
    return box_corner(box, corner[gl_VertexID]);
#endif
}

// `box`: of all pixels that it may cover; a point has none.
void draw(Sprite sprite, ivec4 box) {
    v_Centre = sprite.centre;
    v_Window = sprite.window;
    v_Half = half_of(sprite);
    bool drawn = sprite.drawn && !is_empty(box);
    gl_Position = drawn ? place_of(sprite, box) : vec4(2.0, 2.0, 2.0, 1.0);
#if SPRITE == SPRITE_POINTS
    gl_PointSize = drawn ? sprite.side : 1.0;
#endif
}
