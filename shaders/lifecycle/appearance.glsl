// How the particle at hand looks at its age. Twin: reference/lifecycle/appearance.hpp.

float age() {
    float life = lifetime();
    if (!(life != 0.0))
        return 1.0;
    float t = sub(1.0, ls_divide(remaining(), life));
    return t > 0.0 ? (t < 1.0 ? t : 1.0) : 0.0;
}

float over_life(float first, float end) { return add(first, mul(age(), sub(end, first))); }

float size_now() {
    vec2 both = sizes();
    return over_life(both.x, both.y);
}

vec4 color_now() {
    vec4 first = initial_color(), end = end_color(), now;
    for (int k = 0; k < 4; ++k)
        now[k] = over_life(first[k], end[k]);
    return now;
}
