#version 330 core
#extension GL_ARB_gpu_shader5 : require
// Draws the sphere that fits the billboard, where the square's pixel looks at it, seen without perspective.
#include "arithmetic.glsl"
#include "clamp_to.glsl"
#include "shading.glsl"

flat in vec3 g_Centre;
flat in vec2 g_WindowCentre;
flat in vec2 g_WindowHalf;
flat in float g_Speed;
flat in float g_CollideTime;

uniform mat4 u_Projection;
uniform float u_BillboardRadius;
uniform float u_CollisionTime;

precise out vec4 o_Color;
precise gl_FragDepth;

void main() {
    precise vec2 off = (floor(gl_FragCoord.xy) + 0.5) - g_WindowCentre;
    float dx = ls_divide(off.x, g_WindowHalf.x);
    float dy = ls_divide(off.y, g_WindowHalf.y);
    precise float squared = dx * dx + dy * dy;
    if (!in_unit_interval(squared))
        discard;
    precise float rest = 1.0 - squared;
    vec3 normal = vec3(dx, dy, ls_sqrt(rest));
    precise float z = g_Centre.z + normal.z * u_BillboardRadius;
    vec4 clip = ls_transform(u_Projection, vec3(g_Centre.xy, z));
    precise float depth = ls_divide(clip.z, clip.w) * 0.5 + 0.5;
    gl_FragDepth = clamp_to(depth, 1.0);
    o_Color = quantised(particle_color(normal, g_Speed, g_CollideTime, u_CollisionTime));
}
