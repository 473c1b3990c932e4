#version 430 core
// Every word of the accumulator is 0. Twin: ClearTwin in reference/lights/volume_twin.hpp.
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(r32ui) writeonly uniform uimage3D u_AccumulatorAfter;

void main() {
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    if (all(lessThan(texel, imageSize(u_AccumulatorAfter))))
        imageStore(u_AccumulatorAfter, texel, uvec4(0u));
}
