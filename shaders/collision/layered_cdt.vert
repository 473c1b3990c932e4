#version 330 core
#extension GL_ARB_gpu_shader5 : require
// Puts each particle on the centre of its texel, to be drawn into a layer of the CDT: what the next frame takes for its
// base texel is then where it is stored, on every driver. What is stored where: reference/model/collision/layered_cdt.hpp.
#include "arithmetic.glsl"
#include "base_texel.glsl"

in vec3 a_Position;
in vec3 a_Dir;
in float a_Speed;
in float a_CollideTime;

uniform mat4 u_ProjView;
uniform int u_Layer;            // the layer that is drawn
uniform isampler2D u_KeyBefore; // keys in the layer before; the largest there is where that is empty

precise flat out vec3 v_Position;
precise flat out vec4 v_Velocity; // world units a second, and 1 if the particle will search, else 0
flat out ivec2 v_Key;     // depth, whose bits are ordered like it, and index
precise gl_Position;

// Whether the layers before hold the particle already. Keys grow from layer to layer.
bool stored_before(ivec2 texel, ivec2 key) {
    ivec2 before = texelFetch(u_KeyBefore, texel, 0).xy;
    return key.x < before.x || (key.x == before.x && key.y <= before.y);
}

void main() {
    vec4 clip = ls_transform(u_ProjView, a_Position);
    gl_Position = texel_centre(clip);
    precise float depth = gl_Position.z * 0.5 + 0.5;
    precise vec3 velocity = ls_flush3(a_Dir) * ls_flush(a_Speed);
    v_Position = ls_flush3(a_Position);
    v_Velocity = vec4(ls_flush3(velocity), ls_flush(a_CollideTime) < 0.0 ? 1.0 : 0.0);
    v_Key = ivec2(floatBitsToInt(depth), gl_VertexID);
    ivec2 texel = ivec2(0);
    if (u_Layer > 0 && base_texel(image_position(clip), texel) && stored_before(texel, v_Key))
        gl_Position = vec4(0.0, 0.0, 2.0, 1.0); // outside
}
