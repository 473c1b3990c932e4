#version 430 core
// A corner of a sprite, which faces the camera, or of a ribbon's segment: an instance each. Twin:
// reference/lifecycle/draw_twin.hpp.
#define DRAWS 1
#include "rounding.glsl"
#include "layout.glsl"
#include "appearance.glsl"
#include "polygon.glsl"

in uint a_Kind; // 0: nothing, 1: a sprite, 2: a segment
#ifdef SEGMENTS
in vec3 a_Left, a_Right, a_NextLeft, a_NextRight; // of a segment, in view space
in vec2 a_U;
#endif

#if LAYOUT == LAYOUT_112
in vec3 a_Position, a_InitialColor, a_EndColor;
in float a_InitialSize, a_InitialLifetime, a_InitialOpacity, a_RemainLifetime, a_EndSize, a_EndOpacity;
#elif FLOATS
in vec3 a_Position;
in float a_InitialLifetime, a_RemainLifetime, a_InitialSize, a_EndSize;
in uint a_InitialColor, a_EndColor;
#else
in uint a_PositionXy, a_PositionZVelocityX, a_Lifetimes, a_InitialColor, a_EndColor;
#ifdef RENDERING_GRAPH
in uint a_VelocityYz, a_AccelerationXy, a_AccelerationZSpawn;
#endif
#if LAYOUT == LAYOUT_44 || LAYOUT == LAYOUT_40
in uint a_Sizes;
#else
in float a_InitialSize, a_EndSize;
#endif
#endif

// Besides, what a graph asks for.
#if FLOATS
#ifdef LOOKS_BY_VELOCITY
in vec3 a_Velocity;
#endif
#ifdef LOOKS_BY_ACCELERATION
in vec3 a_Acceleration;
#endif
#ifdef LOOKS_BY_SPAWN_TIME
in float a_SpawnTime;
#endif
#endif

uniform mat4 u_View, u_Projection;
uniform float u_Tick, u_Time;
uniform uint u_FirstQuad; // of those that are drawn together

#include "rendering_graph.glsl"

precise out vec4 out_Clip;
precise out vec4 out_Tint;
flat out uint out_Drawn;
precise out vec2 out_TexelPlace;

// Only what drawing needs.
void load_instance() {
    for (uint k = 0u; k < STRIDE; ++k)
        w[k] = 0u;
#if FLOATS
    set_words(AT_POSITION, a_Position);
    set_word(AT_LIFETIME, a_InitialLifetime);
    set_word(AT_REMAINING, a_RemainLifetime);
#ifdef LOOKS_BY_VELOCITY
    set_words(AT_VELOCITY, a_Velocity);
#endif
#ifdef LOOKS_BY_ACCELERATION
    set_words(AT_ACCELERATION, a_Acceleration);
#endif
#ifdef LOOKS_BY_SPAWN_TIME
    set_word(AT_SPAWN, a_SpawnTime);
#endif
#else
    w[0] = a_PositionXy;
    w[1] = a_PositionZVelocityX;
    w[3] = a_Lifetimes;
#ifdef RENDERING_GRAPH
    w[2] = a_VelocityYz;
    w[4] = a_AccelerationXy;
    w[5] = a_AccelerationZSpawn;
#endif
#endif
#if LAYOUT == LAYOUT_44 || LAYOUT == LAYOUT_40
    w[AT_SIZES] = a_Sizes;
#else
    set_word(AT_SIZE, a_InitialSize);
    set_word(AT_END_SIZE, a_EndSize);
#endif
#if LAYOUT == LAYOUT_112
    set_words(12u, a_InitialColor);
    set_word(11u, a_InitialOpacity);
    set_words(16u, a_EndColor);
    set_word(20u, a_EndOpacity);
#else
    w[AT_COLOR] = a_InitialColor;
    w[AT_COLOR + 1u] = a_EndColor;
#endif
}

void main() {
    load_instance();
    uint quad = u_FirstQuad + uint(gl_InstanceID);
    out_Drawn = a_Kind;
    vec3 seen;
    vec4 color = color_now();
#ifdef SEGMENTS
    if (a_Kind == 2u) {
#ifdef POLYGON
        int corner = min(gl_VertexID, 3) ^ (min(gl_VertexID, 3) >> 1); // around
#else
        int corner = gl_VertexID;
#endif
        bool right = (corner & 1) != 0, next = (corner & 2) != 0;
        seen = ls_flush3(next ? (right ? a_NextRight : a_NextLeft) : (right ? a_Right : a_Left));
        out_TexelPlace = vec2(ls_flush(next ? a_U.y : a_U.x), right ? 1.0 : 0.0);
        float size = 0.0;
        graph_look(quad, out_TexelPlace.x, out_TexelPlace.y, size, color);
    } else
#endif
    {
        out_TexelPlace = corner_of_sprite(gl_VertexID);
        seen = ls_transform(u_View, position()).xyz;
        float size = size_now();
        graph_look(quad, out_TexelPlace.x, out_TexelPlace.y, size, color);
        float reach = mul(size, 0.5);
        seen.x = add(seen.x, mul(sub(mul(2.0, out_TexelPlace.x), 1.0), reach));
        seen.y = add(seen.y, mul(sub(mul(2.0, out_TexelPlace.y), 1.0), reach));
#if EXPIRED == EXPIRED_HIDDEN
        if (!(remaining() > 0.0))
            out_Drawn = 0u;
#endif
    }
    out_Clip = ls_transform(u_Projection, seen);
    out_Tint = color;
    gl_Position = out_Clip;
}
