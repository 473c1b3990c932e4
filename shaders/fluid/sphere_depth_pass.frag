#version 430 core
// The nearest sphere's depth. Twin: reference/fluid/sphere_depth_twin.hpp.
#include "rounding.glsl"
#include "clamp_to.glsl"
#include "pixel_box.glsl"
#include "depth.glsl"
#include "sprite.glsl"
#include "sprite_fragment.glsl"

layout(location = 0) precise out float o_Depth;
precise gl_FragDepth;

#if SPHERE == SPHERE_RAY

// Where the pixel's ray enters the sphere, by its point nearest to the centre (Haines, Guenther and Akenine-Moeller,
// "Precision improvements for ray/sphere intersection", 2019).
bool meets(out float z) {
    vec3 d = vec3(ray_of(ivec2(gl_FragCoord.xy), ivec2(u_ClientWidth, u_ClientHeight)), -1.0);
    float a = ls_dot(d, d);
    float k = ls_divide(ls_dot(d, v_Centre), a);
    vec3 l = sub(v_Centre, mul(d, k));
    float m = sub(mul(pointRadius, pointRadius), ls_dot(l, l));
    z = neg(sub(k, ls_sqrt(ls_divide(m, a))));
    return !(m < 0.0);
}

#else

// A disc with a sphere's depth.
bool meets(out float z) {
    float mag = disc_place();
    z = add(v_Centre.z, mul(pointRadius, ls_sqrt(sub(1.0, mag))));
    return !(mag > 1.0);
}

#endif

float test_depth(float z) {
#if DEPTH_VALUE == DEPTH_VALUE_VIEW
    return mul(neg(z), u_DepthScale);
#else
    return stored_of(z);
#endif
}

void main() {
    float z;
    if (!meets(z) || !(z < 0.0) || !is_seen(z))
        discard;
    o_Depth = stored_of(z);
    gl_FragDepth = test_depth(z);
}
