#version 430 core
// Written to an sRGB image, which GL encodes. Twin: reference/system/encode_twin.hpp.
uniform sampler2D u_LitBefore;

layout(location = 0) out vec4 o_Encoded;

void main() { o_Encoded = vec4(texelFetch(u_LitBefore, ivec2(gl_FragCoord.xy), 0).xyz, 1.0); }
