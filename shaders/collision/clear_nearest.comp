#version 430 core
// Leaves nobody nearest in any texel, before the collision pass offers its particles. One invocation a texel.

layout(local_size_x = 256) in;

layout(std430, binding = 2) writeonly buffer Nearest { uvec2 nearest[]; }; // particle, depth

const uint nobody = 0xffffffffu;

void main() {
    uint texel = gl_GlobalInvocationID.x;
    if (texel < nearest.length())
        nearest[texel] = uvec2(nobody);
}
