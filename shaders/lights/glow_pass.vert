#version 430 core
// A disc around a light: the pixels that it may cover; their fragments decide which it does. Twin:
// reference/lights/glow_twin.hpp.
#include "rounding.glsl"
#include "pixel_box.glsl"

in vec3 a_Position;
in vec3 a_Colour;

uniform mat4 u_ProjView;
uniform float u_DiscScale;

precise flat out vec3 v_Colour;
precise flat out vec2 v_Centre; // pixels
precise flat out float v_Radius;
precise flat out float v_Depth;

void main() {
    vec4 clip = ls_transform(u_ProjView, a_Position);
    v_Colour = ls_flush3(a_Colour);
    v_Centre = vec2(0.0);
    v_Radius = v_Depth = 0.0;
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    if (!is_finite(clip) || !(clip.w > 0.0))
        return;
    v_Depth = add(mul(ls_divide(clip.z, clip.w), 0.5), 0.5);
    v_Centre = window_place(clip.xy, clip.w);
    v_Radius = ls_divide(u_DiscScale, clip.w);
    ivec4 box = pixel_box(v_Centre - v_Radius, v_Centre + v_Radius);
    const int corner[6] = int[6](0, 1, 2, 2, 1, 3);
    if (!is_empty(box))
        gl_Position = box_corner(box, corner[gl_VertexID]);
}
