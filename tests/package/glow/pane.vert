#version 330 core
in vec2 a_Place;

void main() {
    const vec2 corners[6] =
        vec2[6](vec2(0, 0), vec2(2, 0), vec2(2, 1), vec2(0, 0), vec2(2, 1), vec2(0, 1));
    gl_Position = vec4((a_Place + corners[gl_VertexID]) / vec2(4.0, 2.0) - 1.0, 0.0, 1.0);
}
