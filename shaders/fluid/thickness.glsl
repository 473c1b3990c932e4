// What a particle adds to the thickness of the water at a pixel. Needs rounding.glsl.

uniform float u_ThicknessGain; // m

// At a squared distance from the middle of its disc of radius 1.
float thickness_at(float mag) {
    float t = mul(u_ThicknessGain, ls_sqrt(sub(1.0, mag)));
#if THICKNESS_SUM == THICKNESS_SUM_BLEND
    return t;
#elif THICKNESS_SUM == THICKNESS_SUM_BLEND_EXACT
    return mul(floor(add(mul(65536.0, t), 0.5)), 1.0 / 65536.0); // sums of these are exact
#else
    return floor(add(mul(65536.0, t), 0.5));
#endif
}
