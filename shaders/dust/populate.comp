#version 430 core
// Places every grain in the spawn box, alive. Twin: reference/dust/populate_twin.hpp.

#include "dust.glsl"
#include "random.glsl"
#if COLOUR_FORMAT == COLOUR_FORMAT_RGB16F
#include "half.glsl"
#endif

layout(std430) buffer dustColorBuffer { float dustColor[]; }; // three a grain

uniform vec3 spawnBoundsMin, spawnBoundsMax;
uniform vec3 dustColorA, dustColorB;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= dustCount)
        return;
    vec3 at;
    float shade;
#if RANDOM == RANDOM_INTEGER
    at.x = unit(integer_random(i, stream_position, 0u));
    at.y = unit(integer_random(i, stream_position + 1u, 0u));
    at.z = unit(integer_random(i, stream_position + 2u, 0u));
    shade = unit(integer_random(i, stream_colour, 0u));
#else
    float width = sub(spawnBoundsMax.x, spawnBoundsMin.x);
    float row = ls_divide(float(i), width);
#if MODULO == MODULO_FMOD
    float step_of_row = sub(float(i), mul(width, floor(row)));
#else
    float step_of_row = mul(sub(row, floor(row)), width);
#endif
#if POPULATE == POPULATE_UV
    float x = ls_divide(step_of_row, width), y = ls_divide(row, width);
    at = vec3(h1(x, y), h1(add(x, 7.219), add(y, 7.219)), h1(add(x, 79.714), add(y, 79.714)));
#else
    float s = ls_divide(float(i), mul(width, width));
    at = vec3(r11(s), second(s), third(s));
#endif
    shade = r21(vec2(step_of_row, row));
#endif
    vec3 position;
    for (int axis = 0; axis < 3; ++axis)
        position[axis] = lerp(spawnBoundsMin[axis], spawnBoundsMax[axis], at[axis]);
#if POPULATE == POPULATE_PLANE
    position.y = spawnBoundsMin.y;
#endif
    dust[i].position = position;
    dust[i].isAlive = 1;
    vec3 colour = lerp(dustColorA, dustColorB, shade);
#if COLOUR_FORMAT == COLOUR_FORMAT_RGB16F
    colour = vec3(half_round(colour.r), half_round(colour.g), half_round(colour.b));
#endif
    dustColor[3u * i] = colour.r;
    dustColor[3u * i + 1u] = colour.g;
    dustColor[3u * i + 2u] = colour.b;
}
