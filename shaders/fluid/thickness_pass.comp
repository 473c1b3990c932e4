#version 430 core
// A particle adds its thickness, in integers, to every pixel that it covers. Twin: reference/fluid/thickness_twin.hpp.
#include "rounding.glsl"
#include "clamp_to.glsl"
#include "pixel_box.glsl"
#include "depth.glsl"
#include "sprite.glsl"
#include "thickness.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer ParticlesBefore { vec4 positions[]; };

uniform uint u_ParticleCount;

#if SCENE_DEPTH == SCENE_DEPTH_TEST
uniform sampler2D u_SceneDepthBefore;
bool is_seen(ivec2 pixel, float z) { return window_of(z) < texelFetch(u_SceneDepthBefore, pixel, 0).x; }
#else
bool is_seen(ivec2 pixel, float z) { return true; }
#endif

layout(r32ui) coherent uniform uimage2D u_ThicknessAfter;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= u_ParticleCount)
        return;
    Sprite sprite = sprite_of(positions[i].xyz);
    if (!sprite.drawn)
        return;
    ivec4 box = disc_box(sprite);
    for (int y = box.y; y < box.w; ++y)
        for (int x = box.x; x < box.z; ++x) {
            ivec2 pixel = ivec2(x, y);
            float mag = disc_place(pixel, sprite.window, half_of(sprite));
            if (!(mag > 1.0) && is_seen(pixel, sprite.centre.z))
                imageAtomicAdd(u_ThicknessAfter, pixel, uint(thickness_at(mag)));
        }
}
