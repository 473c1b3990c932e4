#version 430 core
// A particle, to be drawn as a sphere. Twin: reference/fluid/sphere_depth_twin.hpp.
#include "rounding.glsl"
#include "clamp_to.glsl"
#include "pixel_box.glsl"
#include "depth.glsl"
#include "sprite.glsl"
#include "sprite_vertex.glsl"

#if SPHERE == SPHERE_RAY
// The pixels whose rays may meet the sphere: along each axis slopes up to those of its two tangents (Mara and McGuire,
// "2D polyhedral bounds of a clipped, perspective-projected 3D sphere", 2013).
ivec4 sphere_box(vec3 c) {
    float q = -c.z;
    float rest = q * q - pointRadius * pointRadius;
    vec2 middle = c.xy * q / rest;
    vec2 reach = pointRadius * sqrt(c.xy * c.xy + rest) / rest;
    vec2 scale = 0.5 * vec2(projection[0][0] * float(u_ClientWidth), projection[1][1] * float(u_ClientHeight));
    vec2 window = 0.5 * vec2(u_ClientWidth, u_ClientHeight) + middle * scale;
    vec2 rounding = (abs(window) + reach * scale) * (q * q / rest) / 1048576.0;
    return pixel_box(window - reach * scale - rounding, window + reach * scale + rounding);
}
#endif

void main() {
    Sprite sprite = sprite_of(a_Position.xyz);
#if SPHERE == SPHERE_RAY
    sprite.drawn = sprite.drawn && ahead_of(sprite) > add(pointRadius, u_Near);
    draw(sprite, sphere_box(sprite.centre));
#else
    draw(sprite, disc_box(sprite));
#endif
}
