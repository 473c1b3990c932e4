#version 430 core
// A light at an offset from its cell: a point in the layer of a voxel, where it reaches that. Instances are the
// offsets, x fastest. Twin: GatherTwin in reference/lights/volume_twin.hpp.
#include "light.glsl"

in vec3 a_Position;
in float a_Range;
in vec3 a_Direction;
in float a_Speed;
in vec3 a_Colour;
in float a_InvRange2;

uniform int u_Reach;
uniform float u_FixedScale;

flat out ivec3 v_Voxel; // z < 0: none
precise flat out vec4 v_Colour;
precise flat out vec4 v_Direction;

#if ACCUMULATE == ACCUMULATE_BLEND_EXACT
// On the grid on which every sum is exact.
float on_grid(float x) { return mul(floor(add(mul(x, u_FixedScale), 0.5)), 1.0 / u_FixedScale); }
vec3 on_grid(vec3 v) { return vec3(on_grid(v.x), on_grid(v.y), on_grid(v.z)); }
#else
float on_grid(float x) { return x; }
vec3 on_grid(vec3 v) { return v; }
#endif

void main() {
    Light light = Light(a_Position, a_Range, a_Direction, a_Speed, a_Colour, a_InvRange2, vec4(0.0));
    gl_Position = vec4(0.0);
    gl_PointSize = 1.0;
    v_Voxel = ivec3(-1);
    v_Colour = v_Direction = vec4(0.0);
    if (!is_finite_light(light))
        return;
    int side = 2 * u_Reach + 1;
    ivec3 offset = ivec3(gl_InstanceID % side, gl_InstanceID / side % side, gl_InstanceID / (side * side));
    ivec3 voxel = cell_of(light.position) + offset - u_Reach;
    Contribution made;
    if (any(lessThan(voxel, ivec3(0))) || any(greaterThanEqual(voxel, u_GridSize)) ||
        !contributes(light, voxel, made))
        return;
    v_Voxel = voxel;
    v_Colour = vec4(on_grid(made.colour), 1.0);
    v_Direction = vec4(on_grid(made.direction), on_grid(made.weight));
}
