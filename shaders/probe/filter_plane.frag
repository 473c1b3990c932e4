#version 330 core
// What the texture unit makes of a place in a plane, as a shader's texture() reads it.
uniform sampler2D u_A; // places, 0 to 1
uniform sampler2D u_Plane;
out vec4 o_Texel;

void main() { o_Texel = texture(u_Plane, texelFetch(u_A, ivec2(gl_FragCoord.xy), 0).xy); }
