#version 430 core
// A corner of a grain's quad, which faces the camera, or cube: an instance a grain. Twin: reference/dust/draw_twin.hpp.
#include "arithmetic.glsl"

in vec3 a_Position;
in int a_Alive;
in vec3 a_Colour;

uniform vec3 cameraRight, cameraUp, cameraBack; // a cube's: the world's axes
uniform float scale;
uniform mat4 viewProjection;

precise out vec4 out_Clip;
precise flat out vec3 out_Tint;
flat out int out_Drawn;
precise out vec2 out_TexelPlace;

void main() {
    // Sides of 1 around 0.
    float x = (gl_VertexID & 1) == 0 ? -0.5 : 0.5;
    float y = (gl_VertexID & 2) == 0 ? -0.5 : 0.5;
#if MESH == MESH_CUBE
    float z = (gl_VertexID & 4) == 0 ? -0.5 : 0.5;
#else
    float z = 0.0;
#endif
    precise vec3 turned, world;
    for (int axis = 0; axis < 3; ++axis) {
        turned[axis] = ls_add(ls_add(ls_multiply(cameraRight[axis], x), ls_multiply(cameraUp[axis], y)),
                              ls_multiply(cameraBack[axis], z));
        world[axis] = ls_add(ls_multiply(turned[axis], scale), ls_flush(a_Position[axis]));
    }
    out_Clip = ls_transform(viewProjection, world);
    out_Tint = ls_flush3(a_Colour);
    out_Drawn = a_Alive;
    out_TexelPlace = vec2(x + 0.5, y + 0.5);
    gl_Position = out_Clip;
}
