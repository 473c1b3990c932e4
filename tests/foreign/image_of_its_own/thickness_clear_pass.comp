#version 430 core
// An image with a name of its own, cleared by groups of another shape.
layout(local_size_x = 32, local_size_y = 2) in;

layout(r32ui) writeonly uniform uimage2D opacity;

void main() {
    const ivec2 size = imageSize(opacity);
    const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (at.x < size.x && at.y < size.y)
        imageStore(opacity, at, uvec4(0u, 0u, 0u, 1u));
}
