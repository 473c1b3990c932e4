#version 430 core
// The light that the water sends to the eye: what it lets through, mirrors and scatters. Twin: reference/fluid/shading.hpp.
#include "rounding.glsl"
#include "clamp_to.glsl"
#include "powers.glsl"
#include "depth.glsl"
#include "source.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D u_NormalBefore;
uniform sampler2D u_SceneBefore;
#if THICKNESS_SUM == THICKNESS_SUM_FIXED
uniform usampler2D u_ThicknessBefore;
#else
uniform sampler2D u_ThicknessBefore;
#endif
layout(rgba32f) writeonly uniform image2D u_LitAfter;

uniform mat4 mView;
uniform mat4 u_InverseView;
uniform vec4 color;
uniform float u_ThicknessFloor;
uniform float u_FresnelR0;
uniform int u_FresnelPower;
uniform float u_SkyBias;

vec3 times(vec3 a, vec3 b) { return vec3(mul(a.x, b.x), mul(a.y, b.y), mul(a.z, b.z)); }
vec3 mixed(vec3 a, vec3 b, float t) { return add(mul(a, sub(1.0, t)), mul(b, t)); }
float above_0(float x) { return x > 0.0 ? x : 0.0; }

float smooth_step(float low, float high, float x) {
    float t = clamp_to(ls_divide(sub(x, low), sub(high, low)), 1.0);
    return mul(mul(t, t), sub(3.0, mul(2.0, t)));
}

vec3 scene_at(ivec2 texel) {
    return ls_flush3(texelFetch(u_SceneBefore, clamp(texel, ivec2(0), textureSize(u_SceneBefore, 0) - 1), 0).xyz);
}

// Of a place on the image, pixels.
vec3 fetched_scene(vec2 at) {
#if SCENE_FETCH == SCENE_FETCH_NEAREST
    return scene_at(ivec2(floor(at)));
#elif SCENE_FETCH == SCENE_FETCH_LINEAR
    vec2 size = vec2(textureSize(u_SceneBefore, 0));
    return ls_flush3(texture(u_SceneBefore, vec2(ls_divide(at.x, size.x), ls_divide(at.y, size.y))).xyz);
#else
    vec2 p = vec2(sub(at.x, 0.5), sub(at.y, 0.5));
    vec2 base = floor(p);
    vec2 f = vec2(sub(p.x, base.x), sub(p.y, base.y));
    ivec2 texel = ivec2(base);
    vec3 low = mixed(scene_at(texel), scene_at(texel + ivec2(1, 0)), f.x);
    vec3 high = mixed(scene_at(texel + ivec2(0, 1)), scene_at(texel + ivec2(1, 1)), f.x);
    return mixed(low, high, f.y);
#endif
}

float thickness_of(ivec2 pixel) {
#if THICKNESS_SUM == THICKNESS_SUM_FIXED
    return mul(float(texelFetch(u_ThicknessBefore, pixel, 0).x), 1.0 / 65536.0);
#else
    return ls_flush(texelFetch(u_ThicknessBefore, pixel, 0).x);
#endif
}

// The scene, bent by the normal, after its way through the water.
vec3 refracted(ivec2 pixel, vec3 normal, float height) {
    float bend = mul(0.03325, smooth_step(0.1, 0.4, height));
    vec2 offset = vec2(mul(mul(bend, 0.75), normal.x), mul(bend, normal.y));
    ivec2 size = image_size();
    vec2 at = vec2(add(add(float(pixel.x), 0.5), mul(offset.x, float(size.x))),
                   add(add(float(pixel.y), 0.5), mul(offset.y, float(size.y))));
    float thickness = thickness_of(pixel);
    thickness = thickness > u_ThicknessFloor ? thickness : u_ThicknessFloor;
    vec3 absorbed = mul(sub(vec3(1.0), color.rgb), thickness);
    vec3 transmission = vec3(exp_of(neg(absorbed.x)), exp_of(neg(absorbed.y)), exp_of(neg(absorbed.z)));
    return times(fetched_scene(at), transmission);
}

// Of a light that shines straight down from 1 km.
vec3 diffuse(vec3 world, vec3 light, vec3 normal) {
    vec3 way = ls_normalize(sub(world, vec3(0.0, 1000.0, 0.0)));
    float spot = smooth_step(0.95, 1.0, abs(way.y));
    spot = spot > 0.05 ? spot : 0.05;
    float s = add(mul(mul(ls_dot(light, normal), spot), 0.5), 0.5);
    vec3 tint = add(mul(vec3(0.29, 0.379, 0.59), sub(1.0, s)), vec3(s));
    return mul(times(color.rgb, tint), sub(1.0, color.a));
}

float fresnel(float cosine) {
    return add(u_FresnelR0, mul(sub(1.0, u_FresnelR0), power(sub(1.0, above_0(cosine)), u_FresnelPower)));
}

vec3 mirrored_sky(vec3 to_eye, vec3 normal) {
#if MIRROR == MIRROR_AS_PUBLISHED
    vec3 incident = to_eye;
#else
    vec3 incident = neg(to_eye);
#endif
    vec3 m = sub(incident, mul(normal, mul(2.0, ls_dot(normal, incident))));
    float up = add(add(mul(u_InverseView[0].y, m.x), mul(u_InverseView[1].y, m.y)), mul(u_InverseView[2].y, m.z));
    vec3 sky = mixed(vec3(0.1, 0.1, 0.2), vec3(0.12, 0.24, 0.96), smooth_step(0.15, 0.25, up));
    return add(vec3(u_SkyBias), sky);
}

vec3 lit(ivec2 pixel, float stored) {
    vec3 e = point_of(pixel, image_size(), unprojected(stored));
    vec3 world = ls_transform(u_InverseView, e).xyz;
    vec3 normal = ls_flush3(texelFetch(u_NormalBefore, pixel, 0).xyz);
    vec3 to_eye = neg(ls_normalize(e));
    vec3 light = mView[1].xyz; // of the sky above
    vec3 halfway = ls_normalize(add(to_eye, light));
    float specular = power(above_0(ls_dot(normal, halfway)), 500);
    float f = fresnel(ls_dot(normal, to_eye));
    vec3 through = mixed(refracted(pixel, normal, world.y), mirrored_sky(to_eye, normal), f);
    return add(diffuse(world, light, normal), mul(add(through, vec3(specular)), color.a));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(pixel))
        return;
    float stored = stored_at(pixel, ivec2(0));
    vec3 seen = is_nothing(stored) ? scene_at(pixel) : is_lost(stored) ? vec3(0.0) : lit(pixel, stored);
    imageStore(u_LitAfter, pixel, vec4(seen, 1.0));
}
