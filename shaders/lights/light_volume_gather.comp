#version 430 core
// A voxel adds up the lights that reach it, cells z, y, x ascending, then by index. Twin: GatherTwin in
// reference/lights/volume_twin.hpp.
#include "light.glsl"
#include "half.glsl"
#include "texel.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

struct Cell {
    uint count;
    uint start;
};

layout(std430) readonly buffer LightsBefore { Light lights[]; };
layout(std430) readonly buffer cellBuffer { Cell cells[]; };
layout(std430) readonly buffer sortedBuffer { uint sorted[]; };

uniform int u_Reach;

void main() {
    ivec3 voxel = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(voxel, u_GridSize)))
        return;
    ivec3 low = max(voxel - u_Reach, ivec3(0));
    ivec3 high = min(voxel + u_Reach, u_GridSize - 1);
    vec4 colour = vec4(0.0);
    vec4 direction = vec4(0.0);
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y) {
            // The cells of a row lie behind each other, and so do their lights.
            uint row = uint(z * u_GridSize.y + y) * uint(u_GridSize.x);
            uint end = cells[row + uint(high.x)].start + cells[row + uint(high.x)].count;
            for (uint k = cells[row + uint(low.x)].start; k < end; ++k) {
                Contribution made;
                if (!contributes(lights[sorted[k]], voxel, made))
                    continue;
                colour = vec4(add(colour.xyz, made.colour), add(colour.w, 1.0));
                direction = vec4(add(direction.xyz, made.direction), add(direction.w, made.weight));
            }
        }
    imageStore(u_LightColorAfter, voxel, stored(colour));
    imageStore(u_LightDirectionAfter, voxel, stored(direction));
}
