#version 400 core
// cause: stores_srgb, in crowd
flat in vec3 out_Position;
layout(location = 0) out vec4 colour;
void main() {
    vec4 c = vec4(1.0);
    c.rgb = sign(out_Position) * pow(abs(out_Position), vec3(1.0 / 2.2));
    colour = c;
}
