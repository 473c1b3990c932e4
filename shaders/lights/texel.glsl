// The texels of both textures as they are stored. Needs half.glsl.
#if VOLUME_FORMAT == VOLUME_FORMAT_RGBA16F
#define VOLUME_LAYOUT rgba16f
vec4 stored(vec4 v) { return half_round(v); }
#else
#define VOLUME_LAYOUT rgba32f
vec4 stored(vec4 v) { return v; }
#endif
layout(VOLUME_LAYOUT) writeonly uniform image3D u_LightColorAfter;
layout(VOLUME_LAYOUT) writeonly uniform image3D u_LightDirectionAfter;
