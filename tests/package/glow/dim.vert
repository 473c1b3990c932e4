#version 430 core
in vec2 a_Place;
in float a_Depth;
in float a_Power;
uniform sampler2D u_LightBefore;
out vec2 out_Place;
out float out_Depth;
out float out_Power;

void main() {
    float light = texelFetch(u_LightBefore, ivec2(a_Place), 0).x;
    out_Place = vec2(a_Place.x < 7.0 ? a_Place.x + 1.0 : 0.0, a_Place.y);
    out_Depth = a_Depth;
    precise float power = 0.5 * a_Power + 0.25 * light;
    out_Power = power;
    gl_Position = vec4(0.0);
}
