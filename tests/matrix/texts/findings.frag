#version 430 core
in vec3 v_Normal;
out vec4 o_Colour;

void main() {
    if (v_Normal.x > 0.5)
        o_Colour = vec4(normalize(v_Normal * 0.0), dFdx(v_Normal.y));
}
