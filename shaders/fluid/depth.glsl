// What the depth images store, and the points of the view that their texels stand for. Needs rounding.glsl and
// clamp_to.glsl.

uniform vec2 u_DepthCoefficients; // A, B: a depth z < 0 in view space is (A z + B) / -z in device coordinates
uniform float u_DepthScale;       // a power of two that takes what is seen to 0..1
uniform float u_DepthCodes;
uniform vec2 u_Slope; // 1 / P00, 1 / P11

#if DEPTH_VALUE == DEPTH_VALUE_VIEW
const float empty_depth = 0.0;
#else
const float empty_depth = 1.0;
#endif

bool is_nothing(float stored) { return stored == empty_depth; }

// Nearer than what a depth buffer of device coordinates can hold.
bool is_lost(float stored) {
#if DEPTH_VALUE == DEPTH_VALUE_VIEW
    return false;
#else
    return stored <= 0.0;
#endif
}

float ndc_of(float z) { return ls_divide(add(mul(u_DepthCoefficients.x, z), u_DepthCoefficients.y), neg(z)); }
float window_of(float z) { return add(mul(ndc_of(z), 0.5), 0.5); }
float z_of_ndc(float ndc) { return ls_divide(neg(u_DepthCoefficients.y), add(ndc, u_DepthCoefficients.x)); }

float on_codes(float depth) {
#if DEPTH_FORMAT == DEPTH_FORMAT_D24
    return ls_divide(floor(add(mul(depth, u_DepthCodes), 0.5)), u_DepthCodes);
#else
    return depth;
#endif
}

float stored_of(float z) {
#if DEPTH_VALUE == DEPTH_VALUE_VIEW
    return z;
#elif DEPTH_VALUE == DEPTH_VALUE_NDC
    return on_codes(clamp_to(ndc_of(z), 1.0));
#else
    return on_codes(clamp_to(window_of(z), 1.0));
#endif
}

float z_of(float stored) {
#if DEPTH_VALUE == DEPTH_VALUE_VIEW
    return stored;
#elif DEPTH_VALUE == DEPTH_VALUE_NDC
    return z_of_ndc(stored);
#else
    return z_of_ndc(sub(mul(stored, 2.0), 1.0));
#endif
}

// As the normals and the shading read it.
float unprojected(float stored) {
#if UNPROJECT == UNPROJECT_AS_NDC
    return z_of_ndc(stored);
#else
    return z_of(stored);
#endif
}

// The slope of a pixel's ray.
vec2 ray_of(ivec2 pixel, ivec2 size) {
    ivec2 from_centre = 2 * pixel + 1 - size;
    return vec2(mul(ls_divide(float(from_centre.x), float(size.x)), u_Slope.x),
                mul(ls_divide(float(from_centre.y), float(size.y)), u_Slope.y));
}

// The point of a pixel at depth z, view space.
vec3 point_of(ivec2 pixel, ivec2 size, float z) {
    vec2 ray = ray_of(pixel, size);
    return vec3(mul(neg(z), ray.x), mul(neg(z), ray.y), z);
}
