#version 430 core
// A sprite is a round, soft blob; along a ribbon u and v make a pattern that repeats.
in vec4 out_Tint;
flat in uint out_Drawn;
in vec2 out_TexelPlace;

precise out vec4 o_Color;

void main() {
    if (out_Drawn == 0u)
        discard;
    float alpha;
    if (out_Drawn == 1u) {
        vec2 from_centre = out_TexelPlace * 2.0 - 1.0;
        alpha = max(0.0, 1.0 - dot(from_centre, from_centre));
    } else {
        float along = fract(out_TexelPlace.x);
        alpha = along < 0.5 == out_TexelPlace.y < 0.5 ? 1.0 : 0.35;
    }
    o_Color = vec4(out_Tint.rgb, out_Tint.a * alpha);
}
