#version 430 core
// A corner of an obstacle, into clip space.
#include "arithmetic.glsl"

in vec3 a_CornerPosition;

uniform mat4 u_ProjView;

precise out vec3 v_Position;
precise gl_Position;

void main() {
    v_Position = ls_flush3(a_CornerPosition);
    gl_Position = ls_transform(u_ProjView, a_CornerPosition);
}
