#version 430 core
// The layer of a point.
layout(points) in;
layout(points, max_vertices = 1) out;

uniform ivec3 u_GridSize;

flat in ivec3 v_Voxel[];
flat in vec4 v_Colour[];
flat in vec4 v_Direction[];

flat out vec4 g_Colour;
flat out vec4 g_Direction;

void main() {
    ivec3 voxel = v_Voxel[0];
    if (voxel.z < 0)
        return;
    g_Colour = v_Colour[0];
    g_Direction = v_Direction[0];
    gl_Layer = voxel.z;
    gl_PointSize = 1.0;
    gl_Position = vec4((2.0 * vec2(voxel.xy) + 1.0) / vec2(u_GridSize.xy) - 1.0, 0.0, 1.0);
    EmitVertex();
    EndPrimitive();
}
