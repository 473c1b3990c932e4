#version 330 core
// Reads one texel a vertex.
in vec2 a_Texel;
uniform sampler2D u_Texture;
out vec4 out_Texel;

void main() {
    out_Texel = texelFetch(u_Texture, ivec2(a_Texel), 0);
    gl_Position = vec4(0.0);
}
