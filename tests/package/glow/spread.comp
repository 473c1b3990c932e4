#version 430 core
layout(local_size_x = 4, local_size_y = 4) in;
uniform sampler2D u_LightBefore;
uniform sampler3D u_HazeBefore;
layout(r32f) writeonly uniform image3D u_HazeAfter;

void main() {
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(texel, imageSize(u_HazeAfter))))
        return;
    float share = texel.z == 0 ? 1.0 : 0.25;
    precise float haze = 0.5 * texelFetch(u_HazeBefore, texel, 0).x + share * texelFetch(u_LightBefore, texel.xy, 0).x;
    imageStore(u_HazeAfter, texel, vec4(haze));
}
