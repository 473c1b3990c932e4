#version 430 core
// Writes the position of the particle nearest to the collision camera into its texel of the collision detection texture;
// the depth test holds it against the obstacles.
#include "collision_code.glsl"

struct Particle {
    vec3 position;
    float speed;
    vec3 direction;
    float collide_time;
};

layout(std430, binding = 1) readonly buffer After { Particle after[]; };
layout(std430, binding = 2) readonly buffer Nearest { uint nearest[]; }; // two a texel: particle, depth

uniform int u_ClientWidth;
uniform uint u_ParticleCount;

precise out vec4 o_Texel;

void main() {
    uint texel = uint(int(gl_FragCoord.y) * u_ClientWidth + int(gl_FragCoord.x));
    uint particle = nearest[2u * texel];
    if (particle >= u_ParticleCount) // nobody
        discard;
    gl_FragDepth = uintBitsToFloat(nearest[2u * texel + 1u]);
    o_Texel = encode_position(after[particle].position);
}
