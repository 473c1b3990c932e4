#version 430 core
// The accumulator's words to floats: (C, count) and (D, W). Twin: ResolveTwin in reference/lights/volume_twin.hpp.
#include "rounding.glsl"
#include "half.glsl"
#include "texel.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

uniform ivec3 u_GridSize;
uniform float u_FixedScale;

#if ACCUMULATE == ACCUMULATE_FIXED64 || ACCUMULATE == ACCUMULATE_FIXED32

uniform usampler3D u_AccumulatorBefore;

uint word_at(ivec3 voxel, int word) {
    return texelFetch(u_AccumulatorBefore, ivec3(voxel.xy, voxel.z + word * u_GridSize.z), 0).x;
}
float whole(int bits) { return add(mul(float(bits >> 12), 4096.0), float(bits & 4095)); }

#if ACCUMULATE == ACCUMULATE_FIXED64
float channel(ivec3 voxel, int k) {
    uint low = word_at(voxel, 2 * k);
    int high = int(word_at(voxel, 2 * k + 1));
    return add(whole(high), mul(float(low >> 8), 1.0 / 16777216.0));
}
float count(ivec3 voxel) { return float(word_at(voxel, 14)); }
#else
float channel(ivec3 voxel, int k) { return mul(whole(int(word_at(voxel, k))), 1.0 / u_FixedScale); }
float count(ivec3 voxel) { return float(word_at(voxel, 7)); }
#endif

#else

uniform sampler3D u_AccumulatorBefore;

float channel(ivec3 voxel, int k) {
    return ls_flush(texelFetch(u_AccumulatorBefore, ivec3(voxel.xy, voxel.z + k * u_GridSize.z), 0).x);
}
float count(ivec3 voxel) { return channel(voxel, 7); }

#endif

void main() {
    ivec3 voxel = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(voxel, u_GridSize)))
        return;
    vec4 colour = vec4(channel(voxel, 0), channel(voxel, 1), channel(voxel, 2), count(voxel));
    vec4 direction = vec4(channel(voxel, 3), channel(voxel, 4), channel(voxel, 5), channel(voxel, 6));
    imageStore(u_LightColorAfter, voxel, stored(colour));
    imageStore(u_LightDirectionAfter, voxel, stored(direction));
}
