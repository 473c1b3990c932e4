// The narrow-range filter (Truong and Yuksel, "A Narrow-Range Filter for Screen-Space Fluid Rendering", 2018). Needs
// working.glsl.

uniform float u_NarrowScale;
uniform float u_NarrowDelta; // m, how far nearer or farther than what is taken a sample may be
uniform float u_NarrowMu;    // m, how far behind the centre one is put that is farther
uniform ivec2 blurDir;

// View depths that are taken; larger is nearer.
struct Range {
    float high;
    float low;
};

Range range_around(float z) { return Range(add(z, u_NarrowDelta), sub(z, u_NarrowDelta)); }

// Whether a sample counts. One that is far or empty is put behind the centre; others widen the range.
bool judge(ivec2 pixel, ivec2 offset, float z, inout Range range, out float s) {
    float stored = stored_at(pixel, offset);
    bool empty = is_nothing(stored);
    s = empty ? 0.0 : z_of(stored);
    if (!empty && s > range.high)
        return false;
    if (empty || s < range.low) {
        s = sub(z, u_NarrowMu);
        return true;
    }
    float high = add(s, u_NarrowDelta);
    float low = sub(s, u_NarrowDelta);
    range.high = high > range.high ? high : range.high;
    range.low = low < range.low ? low : range.low;
    return true;
}

// Pixels to each side.
int reach_of(float z) {
    float n = ceil(ls_divide(u_NarrowScale, abs(z)));
    return int(n < 20.0 ? n : 20.0);
}

// exp(-d^2 / (2 sigma^2)) of an offset, sigma = n / 3.
float weight_of(ivec2 offset, int n) {
    float twice = float(2 * n * n);
#if NARROW_WEIGHTS == NARROW_WEIGHTS_PIXELS
    float x = ls_divide(float(9 * (offset.x * offset.x + offset.y * offset.y)), twice);
#else
    float width = float(image_size().x);
    float ux = ls_divide(float(offset.x), width);
    float uy = ls_divide(float(offset.y), width);
    float x = ls_divide(mul(add(mul(ux, ux), mul(uy, uy)), 9.0), twice);
#endif
    return exp_of(neg(x));
}

struct Mean {
    float sum;
    float weight;
};

// Two samples, each the other's partner: where one is too near, neither counts. The second is judged by ranges[of_b].
void take_pair(ivec2 pixel, ivec2 offset, float z, float w, int of_b, inout Range ranges[2], inout Mean mean) {
    float a, b;
    bool a_counts = judge(pixel, offset, z, ranges[0], a);
    bool b_counts = judge(pixel, -offset, z, ranges[of_b], b);
    float counted = a_counts && b_counts ? w : 0.0;
    mean.sum = add(mean.sum, add(mul(a, counted), mul(b, counted)));
    mean.weight = add(mean.weight, add(counted, counted));
}

#if FILTER_STEP == FILTER_STEP_ALONG

void take_all(ivec2 pixel, float z, int n, inout Mean mean) {
    Range ranges[2] = Range[2](range_around(z), range_around(z));
    for (int j = 1; j <= n; ++j)
        take_pair(pixel, j * blurDir, z, weight_of(ivec2(j, 0), n), 1, ranges, mean);
}

#elif NARROW_CLEANUP == NARROW_CLEANUP_QUADRANTS

void take_all(ivec2 pixel, float z, int n, inout Mean mean) {
    Range range = range_around(z);
    for (int x = 1; x <= n; ++x)
        for (int y = 1; y <= n; ++y) {
            float s1, s2, s3, s4;
            bool counts1 = judge(pixel, ivec2(x, y), z, range, s1);
            bool counts2 = judge(pixel, ivec2(x, -y), z, range, s2);
            bool counts3 = judge(pixel, ivec2(-x, y), z, range, s3);
            bool counts4 = judge(pixel, ivec2(-x, -y), z, range, s4);
            float w = weight_of(ivec2(x, y), n);
            float w14 = counts1 && counts4 ? w : 0.0;
            float w23 = counts2 && counts3 ? w : 0.0;
            mean.sum = add(mean.sum, add(add(add(mul(s1, w14), mul(s2, w23)), mul(s3, w23)), mul(s4, w14)));
            mean.weight = add(mean.weight, add(add(add(w14, w23), w23), w14));
        }
}

#else

void take_all(ivec2 pixel, float z, int n, inout Mean mean) {
    Range ranges[2] = Range[2](range_around(z), range_around(z));
    for (int y = -n; y <= 0; ++y)
        for (int x = -n; y < 0 ? x <= n : x < 0; ++x)
            take_pair(pixel, ivec2(x, y), z, weight_of(ivec2(x, y), n), 0, ranges, mean);
}

#endif

float filtered(ivec2 pixel, float z) {
    Mean mean = Mean(z, 1.0);
    take_all(pixel, z, reach_of(z), mean);
    return ls_divide(mean.sum, mean.weight);
}
