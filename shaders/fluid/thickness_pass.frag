#version 430 core
// A particle's thickness. Twin: reference/fluid/thickness_twin.hpp.
#include "rounding.glsl"
#include "clamp_to.glsl"
#include "pixel_box.glsl"
#include "depth.glsl"
#include "sprite.glsl"
#include "sprite_fragment.glsl"
#include "thickness.glsl"

layout(location = 0) precise out float o_Thickness;

void main() {
    float mag = disc_place();
    if (mag > 1.0 || !is_seen(v_Centre.z))
        discard;
    o_Thickness = thickness_at(mag);
}
