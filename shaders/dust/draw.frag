#version 430 core
// A round, soft blob of the grain's colour; alpha darkens its edge, and blending darkens it once more. Dead grains are
// dropped here.
flat in vec3 out_Tint;
flat in int out_Drawn;
in vec2 out_TexelPlace;

precise out vec4 o_Color;

void main() {
    if (out_Drawn == 0)
        discard;
#if MESH == MESH_CUBE
    o_Color = vec4(0.2, 0.2, 0.2, 1.0);
#else
    vec2 fromCentre = out_TexelPlace * 2.0 - 1.0;
    float alpha = max(0.0, 1.0 - dot(fromCentre, fromCentre));
    o_Color = vec4(out_Tint * alpha, alpha);
#endif
}
