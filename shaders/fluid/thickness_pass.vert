#version 430 core
// A particle, whose thickness is added. Twin: reference/fluid/thickness_twin.hpp.
#include "rounding.glsl"
#include "clamp_to.glsl"
#include "pixel_box.glsl"
#include "depth.glsl"
#include "sprite.glsl"
#include "sprite_vertex.glsl"

void main() {
    Sprite sprite = sprite_of(a_Position.xyz);
    draw(sprite, disc_box(sprite));
}
