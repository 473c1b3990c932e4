// Where on its particle's sprite a fragment is. Needs sprite.glsl.

flat in vec3 v_Centre;
flat in vec2 v_Window;
flat in float v_Half;

// The squared distance from the middle of a disc of radius 1.
float disc_place() {
#if SPRITE == SPRITE_POINTS
    float nx = sub(mul(2.0, gl_PointCoord.x), 1.0);
    float ny = sub(mul(2.0, gl_PointCoord.y), 1.0);
    return add(mul(nx, nx), mul(ny, ny));
#else
    return disc_place(ivec2(gl_FragCoord.xy), v_Window, v_Half);
#endif
}

#if SCENE_DEPTH == SCENE_DEPTH_TEST
uniform sampler2D u_SceneDepthBefore;
bool is_seen(float z) { return window_of(z) < texelFetch(u_SceneDepthBefore, ivec2(gl_FragCoord.xy), 0).x; }
#else
bool is_seen(float z) { return true; }
#endif
