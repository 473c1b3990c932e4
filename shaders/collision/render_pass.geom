#version 330 core
#extension GL_ARB_gpu_shader5 : require
// Turns each particle into a camera-facing square (billboard), parallel to the image. In the exact preset it draws the
// pixels the square may cover; the fragments outside the disc are dropped either way.
#include "arithmetic.glsl"
#include "pixel_box.glsl"

layout(points) in;
layout(triangle_strip, max_vertices = 4) out;

in vec3 v_Centre[];
in float v_Speed[];
in float v_CollideTime[];

uniform mat4 u_Projection;
uniform float u_BillboardRadius;

precise flat out vec3 g_Centre;       // view space
precise flat out vec2 g_WindowCentre; // pixels
precise flat out vec2 g_WindowHalf;   // pixels, half sides
precise flat out float g_Speed;
precise flat out float g_CollideTime;
precise gl_Position;

// In front of the camera, between near and far plane, not beside the image. False for NaN.
bool is_visible(vec4 low, vec4 high) {
    float w = low.w;
    return w > 0.0 && abs(low.z) <= w && low.x <= w && low.y <= w && high.x >= -w && high.y >= -w;
}

void main() {
    vec3 centre = v_Centre[0];
    precise vec3 low_corner = vec3(centre.x - u_BillboardRadius, centre.y - u_BillboardRadius, centre.z);
    precise vec3 high_corner = vec3(centre.x + u_BillboardRadius, centre.y + u_BillboardRadius, centre.z);
    vec4 low = ls_transform(u_Projection, low_corner);
    vec4 high = ls_transform(u_Projection, high_corner);
    if (!is_visible(low, high))
        return;
    vec2 window_low = window_place(low.xy, low.w);
    vec2 window_high = window_place(high.xy, low.w);
    precise vec2 window_centre = (window_low + window_high) * 0.5;
    precise vec2 window_half = (window_high - window_low) * 0.5;
#if ARITHMETIC == ARITHMETIC_EXACT
    ivec4 box = pixel_box(window_low, window_high);
    if (is_empty(box))
        return;
#endif
    for (int i = 0; i < 4; ++i) {
        g_Centre = centre;
        g_WindowCentre = window_centre;
        g_WindowHalf = window_half;
        g_Speed = v_Speed[0];
        g_CollideTime = v_CollideTime[0];
#if ARITHMETIC == ARITHMETIC_EXACT
        gl_Position = box_corner(box, i);
#else
        gl_Position = vec4((i & 1) == 0 ? low.x : high.x, i < 2 ? low.y : high.y, low.z, low.w);
#endif
        EmitVertex();
    }
    EndPrimitive();
}
