// Nothing but the atomics that light_volume_scatter.comp makes, as many: what it cannot be faster than.
layout(local_size_x = 64) in;

layout(r32ui) coherent uniform uimage3D u_AccumulatorAfter;

uniform ivec3 u_GridSize;
uniform uint u_LightCount;
uniform uint u_VoxelsEach;
uniform int u_WordCount;

void add_to_each_word(ivec3 voxel, uint addend) {
    for (int word = 0; word < u_WordCount; ++word)
        imageAtomicAdd(u_AccumulatorAfter, ivec3(voxel.xy, voxel.z + word * u_GridSize.z), addend);
}
