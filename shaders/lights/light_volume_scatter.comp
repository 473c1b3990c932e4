#version 430 core
// A light adds itself to every voxel that it reaches. Twin: ScatterTwin in reference/lights/volume_twin.hpp.
#if ACCUMULATE == ACCUMULATE_FLOAT_ATOMIC
#extension GL_NV_shader_atomic_float : require
#endif
#include "light.glsl"

layout(local_size_x = 64) in;

layout(std430) readonly buffer LightsBefore { Light lights[]; };

uniform uint u_LightCount;
uniform float u_FixedScale;

#if ACCUMULATE == ACCUMULATE_FLOAT_ATOMIC
layout(r32f) coherent uniform image3D u_AccumulatorAfter;
#else
layout(r32ui) coherent uniform uimage3D u_AccumulatorAfter;
#endif

ivec3 word_of(ivec3 voxel, int word) { return ivec3(voxel.xy, voxel.z + word * u_GridSize.z); }

#if ACCUMULATE == ACCUMULATE_FIXED64

// floor(x 2^32) in two words. The number of carries does not depend on the order.
void add_to(ivec3 voxel, int channel, float x) {
    float magnitude = abs(x);
    if (!(magnitude < 2147483648.0))
        return;
    float whole = floor(magnitude);
    precise float rest = (magnitude - whole) * 4294967296.0;
    uint low = uint(rest);
    int high = int(whole);
    if (x < 0.0) {
        low = uint(ceil(rest));
        high = -high - (low != 0u ? 1 : 0);
        low = 0u - low;
    }
    uint old = imageAtomicAdd(u_AccumulatorAfter, word_of(voxel, 2 * channel), low);
    uint carry = old + low < low ? 1u : 0u;
    imageAtomicAdd(u_AccumulatorAfter, word_of(voxel, 2 * channel + 1), uint(high) + carry);
}
const int count_word = 14;

#elif ACCUMULATE == ACCUMULATE_FIXED32

void add_to(ivec3 voxel, int channel, float x) {
    int q = int(floor(add(mul(x, u_FixedScale), 0.5)));
    imageAtomicAdd(u_AccumulatorAfter, word_of(voxel, channel), uint(q));
}
const int count_word = 7;

#elif ACCUMULATE == ACCUMULATE_FLOAT_CAS

void add_to(ivec3 voxel, int channel, float x) {
    ivec3 at = word_of(voxel, channel);
    uint expected = imageLoad(u_AccumulatorAfter, at).x;
    for (;;) {
        uint sum = floatBitsToUint(add(uintBitsToFloat(expected), x));
        uint found = imageAtomicCompSwap(u_AccumulatorAfter, at, expected, sum);
        if (found == expected)
            break;
        expected = found;
    }
}
const int count_word = 7;

#elif ACCUMULATE == ACCUMULATE_FLOAT_ATOMIC

void add_to(ivec3 voxel, int channel, float x) { imageAtomicAdd(u_AccumulatorAfter, word_of(voxel, channel), x); }
const int count_word = 7;

#else // racing

void add_to(ivec3 voxel, int channel, float x) {
    ivec3 at = word_of(voxel, channel);
    float sum = add(uintBitsToFloat(imageLoad(u_AccumulatorAfter, at).x), x);
    imageStore(u_AccumulatorAfter, at, uvec4(floatBitsToUint(sum)));
}
const int count_word = 7;

#endif

void count_one(ivec3 voxel) {
#if ACCUMULATE == ACCUMULATE_FIXED64 || ACCUMULATE == ACCUMULATE_FIXED32
    imageAtomicAdd(u_AccumulatorAfter, word_of(voxel, count_word), 1u);
#else
    add_to(voxel, count_word, 1.0);
#endif
}

// The voxels that the light's ball touches along an axis, and one more to each side, within the grid.
ivec2 reached(Light light, int axis) {
    precise float low = floor((light.position[axis] - light.range - u_GridOrigin[axis]) * u_InvVoxelSize) - 1.0;
    precise float high = floor((light.position[axis] + light.range - u_GridOrigin[axis]) * u_InvVoxelSize) + 1.0;
    float end = float(u_GridSize[axis]);
    return ivec2(max(int(clamp(low, -1.0, end)), 0), min(int(clamp(high, -1.0, end)), u_GridSize[axis] - 1));
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= u_LightCount)
        return;
    Light light = lights[i];
    if (!is_finite_light(light))
        return;
    ivec2 xs = reached(light, 0);
    ivec2 ys = reached(light, 1);
    ivec2 zs = reached(light, 2);
    for (int z = zs.x; z <= zs.y; ++z)
        for (int y = ys.x; y <= ys.y; ++y)
            for (int x = xs.x; x <= xs.y; ++x) {
                ivec3 voxel = ivec3(x, y, z);
                Contribution made;
                if (!contributes(light, voxel, made))
                    continue;
                add_to(voxel, 0, made.colour.x);
                add_to(voxel, 1, made.colour.y);
                add_to(voxel, 2, made.colour.z);
                add_to(voxel, 3, made.direction.x);
                add_to(voxel, 4, made.direction.y);
                add_to(voxel, 5, made.direction.z);
                add_to(voxel, 6, made.weight);
                count_one(voxel);
            }
}
