#version 430 core
// Gives a dead grain one chance in a hundred to come out of the emitter. Twin: reference/dust/emit_twin.hpp.

#include "dust.glsl"
#include "random.glsl"

layout(std430) readonly buffer directionBuffer { vec2 directions[]; }; // 4,096, evenly around the circle

uniform uint frame;
uniform float time;
uniform vec3 controllerPos;
uniform mat4 controllerMatrix;
uniform float emitterForce, emitterDist, emitterAngleRad, emitterTangent;
uniform float mass, impulseDeltaTime;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= dustCount || dust[i].isAlive == 1)
        return;
#if RANDOM == RANDOM_INTEGER
    float chance = unit(integer_random(i, stream_chance, frame));
#else
    float chance = r11(ls_divide(add(float(i), time), 79238.288));
#endif
    if (!(chance <= 0.01))
        return;
#if EMIT_SEED == EMIT_SEED_INDEX_TIME
    uint drawn_in = frame;
    float seed_of_ray = add(float(i), time);
#else
    uint drawn_in = 0u;
    float seed_of_ray = float(i);
#endif
#if RANDOM == RANDOM_INTEGER
    vec2 circle = directions[integer_random(i, stream_angle, drawn_in) >> 20];
    float rho = unit(integer_random(i, stream_radius, drawn_in));
    float tangent = emitterTangent;
#else
    float s = ls_divide(seed_of_ray, 82801.277);
    float turn = lerp(-6.28318530, 6.28318530, r11(s));
    vec2 circle = vec2(portable_cosine(turn), portable_sine(turn));
    float rho = second(s);
    float tangent = ls_divide(portable_sine(emitterAngleRad), portable_cosine(emitterAngleRad));
#endif
#if EMIT_DISC == EMIT_DISC_EVEN
    rho = ls_sqrt(rho);
#endif
    vec3 local = vec3(mul(mul(circle.x, rho), tangent), mul(mul(circle.y, rho), tangent), 1.0);
    vec3 v = mul(direction(controllerMatrix, local), emitterForce);
#if EMIT_SPEED == EMIT_SPEED_FORCE
    v = mul(divided(mul(v, emitterDist), mass), impulseDeltaTime);
#endif
    set_velocity(i, v);
    dust[i].position = controllerPos;
    come_alive(i);
}
