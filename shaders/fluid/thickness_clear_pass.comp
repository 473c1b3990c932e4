#version 430 core
// No thickness. Twin: reference/fluid/thickness_twin.hpp.
layout(local_size_x = 8, local_size_y = 8) in;

layout(r32ui) writeonly uniform uimage2D u_ThicknessAfter;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(pixel, imageSize(u_ThicknessAfter))))
        imageStore(u_ThicknessAfter, pixel, uvec4(0u));
}
