#version 330 core
// Writes a float as it is; the format of the image decides what becomes of it.
uniform sampler2D u_A;
out vec4 o_Texel;

void main() { o_Texel = texelFetch(u_A, ivec2(gl_FragCoord.xy), 0); }
