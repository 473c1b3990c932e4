#version 430 core
// Added to both textures by blending.
flat in vec4 g_Colour;
flat in vec4 g_Direction;

layout(location = 0) out vec4 o_Colour;
layout(location = 1) out vec4 o_Direction;

void main() {
    o_Colour = g_Colour;
    o_Direction = g_Direction;
}
