// The Gaussian and the bilateral filter: the mean of the depths around a pixel, weighted by their distance on the image
// and, bilateral, in depth. Needs working.glsl.

uniform int filterRadius; // pixels
uniform float blurScale;  // 1 / pixels
uniform float u_RangeScale;
uniform ivec2 blurDir;

#if TRANSCENDENTALS == TRANSCENDENTALS_PORTABLE
layout(std430) readonly buffer weightBuffer { float weights[]; };
float weight_of(int j) { return ls_flush(weights[abs(j)]); }
#else
float weight_of(int j) {
    float q = mul(float(j), blurScale);
    return exp_of(neg(mul(q, q)));
}
#endif

struct Mean {
    float sum;
    float weight;
};

void take(ivec2 pixel, ivec2 offset, float centre, float w, inout Mean mean) {
    float stored = stored_at(pixel, offset);
    if (is_nothing(stored))
        return;
    float s = working_of(stored);
#if FILTER == FILTER_BILATERAL
    float q = mul(sub(s, centre), u_RangeScale);
    float v = exp_of(neg(mul(q, q)));
    mean.sum = add(mean.sum, mul(mul(s, w), v));
    mean.weight = add(mean.weight, mul(w, v));
#else
    mean.sum = add(mean.sum, mul(s, w));
    mean.weight = add(mean.weight, w);
#endif
}

float filtered(ivec2 pixel, float centre) {
    Mean mean = Mean(0.0, 0.0);
#if FILTER_STEP == FILTER_STEP_PLANE
    for (int y = -filterRadius; y <= filterRadius; ++y)
        for (int x = -filterRadius; x <= filterRadius; ++x)
            take(pixel, ivec2(x, y), centre, mul(weight_of(x), weight_of(y)), mean);
#else
    for (int j = -filterRadius; j <= filterRadius; ++j)
        take(pixel, j * blurDir, centre, weight_of(j), mean);
#endif
    return ls_divide(mean.sum, mean.weight);
}
