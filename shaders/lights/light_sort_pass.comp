#version 430 core
// The lights by cell, and by index within one. An invocation has a row of cells along x: it counts their lights and
// those of all rows before, and puts its own in their places. Twins: CellTwin and SortTwin in
// reference/lights/volume_twin.hpp.
#include "light.glsl"

layout(local_size_x = 64) in;

struct Cell {
    uint count;
    uint start;
};

layout(std430) readonly buffer LightsBefore { Light lights[]; };
layout(std430) buffer cellBuffer { Cell cells[]; };
layout(std430) buffer sortedBuffer { uint sorted[]; };

uniform uint u_LightCount;

ivec3 nearest_cell(Light light) { return clamp(cell_of(light.position), ivec3(0), u_GridSize - 1); }

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= uint(u_GridSize.y * u_GridSize.z))
        return;
    uint first = row * uint(u_GridSize.x);
    for (int x = 0; x < u_GridSize.x; ++x)
        cells[first + uint(x)].count = 0u;
    uint before = 0u;
    for (uint i = 0u; i < u_LightCount; ++i) {
        Light light = lights[i];
        if (!is_finite_light(light))
            continue;
        ivec3 cell = nearest_cell(light);
        uint of_light = uint(cell.z * u_GridSize.y + cell.y);
        if (of_light < row)
            ++before;
        else if (of_light == row)
            ++cells[first + uint(cell.x)].count;
    }
    for (int x = 0; x < u_GridSize.x; ++x) {
        cells[first + uint(x)].start = before;
        before += cells[first + uint(x)].count;
        cells[first + uint(x)].count = 0u;
    }
    for (uint i = 0u; i < u_LightCount; ++i) {
        Light light = lights[i];
        if (!is_finite_light(light))
            continue;
        ivec3 cell = nearest_cell(light);
        if (uint(cell.z * u_GridSize.y + cell.y) != row)
            continue;
        uint at = first + uint(cell.x);
        sorted[cells[at].start + cells[at].count] = i;
        ++cells[at].count;
    }
}
