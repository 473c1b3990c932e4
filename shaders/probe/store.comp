#version 430 core
// Writes a float as it is by imageStore; the format of the image decides what becomes of it.
layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Given { float given[]; };
layout(rgba16f) writeonly uniform image2D u_Target;

void main() {
    int i = int(gl_GlobalInvocationID.x);
    int width = imageSize(u_Target).x;
    imageStore(u_Target, ivec2(i % width, i / width),
               vec4(given[4 * i], given[4 * i + 1], given[4 * i + 2], given[4 * i + 3]));
}
