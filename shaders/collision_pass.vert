#version 330 core
#extension GL_ARB_gpu_shader5 : require
// The collision pass (thesis, Fig. 3-3), one vertex a particle: projects it to a texel of the collision detection
// texture, finds the nearest stored position round that texel, and answers, or lets gravity move it.
// Line numbers are the listing's. The switches are the scene file's; see README.

#include "arithmetic.glsl"
#include "collision_code.glsl"

in vec3 a_Position;
in vec3 a_Dir;
in float a_Speed;
in float a_CollideTime;

uniform mat4 u_ProjView;
uniform sampler2D u_CDTexture;
uniform int u_ClientWidth;
uniform int u_ClientHeight;
uniform int u_TexelCollideRange;
uniform float u_CollisionRange;
uniform float u_CollisionTime;
uniform float u_SpeedFactor;
uniform float u_Tick;
uniform vec3 u_Gravity;

precise out vec3 v_Position;
precise out vec3 v_Dir;
precise out float v_Speed;
precise out float v_CollideTime;
precise gl_Position;

// Each operation a rounding of its own: the locals are `precise`, so no product melts into a sum.
float product(float a, float b) {
    precise float result = a * b;
    return ls_flush(result);
}

vec3 product(vec3 v, float s) {
    precise vec3 result = v * s;
    return ls_flush3(result);
}

vec3 sum(vec3 a, vec3 b) {
    precise vec3 result = a + b;
    return ls_flush3(result);
}

// Lines 2 and 3, before the cast to integers: where clip space lies on the image, in texels.
vec2 image_position(vec4 clip) {
    precise vec2 ndc = clip.xy;
#if PERSPECTIVE_DIVIDE == PERSPECTIVE_DIVIDE_ON
    ndc = vec2(ls_divide(clip.x, clip.w), ls_divide(clip.y, clip.w));
#endif
    precise vec2 tex_coord = (ndc + vec2(1.0)) * 0.5;
    precise vec2 scaled = vec2(tex_coord.x * float(u_ClientWidth), tex_coord.y * float(u_ClientHeight));
    return scaled;
}

// Line 4. False where the texel lies outside the image, or nowhere: the cast is only made where it is defined.
bool base_texel(vec2 scaled, out ivec2 texel) {
    texel = ivec2(0);
    vec2 size = vec2(u_ClientWidth, u_ClientHeight);
#if BASE_TEXEL == BASE_TEXEL_TRUNCATE
    bool inside = scaled.x > -1.0 && scaled.y > -1.0 && scaled.x < size.x && scaled.y < size.y;
#else
    bool inside = scaled.x >= 0.0 && scaled.y >= 0.0 && scaled.x < size.x && scaled.y < size.y;
#endif
    if (inside)
        texel = ivec2(scaled);
    return inside;
}

bool holds_particle(vec4 stored) {
#if EMPTY_TEXEL == EMPTY_TEXEL_SKIP
    return stored.a != 0.0;
#else
    return true;
#endif
}

bool on_image(ivec2 texel) {
    return texel.x >= 0 && texel.y >= 0 && texel.x < u_ClientWidth && texel.y < u_ClientHeight;
}

// Lines 5 to 19. True when a stored position lies within the collision range; `away` then is own minus nearest.
bool nearest_collision(ivec2 texel_base, out vec3 away) {
    away = vec3(0.0);
    precise vec3 curr_pos = a_Position;
#if SELF_POSITION == SELF_POSITION_TEXEL
    vec4 stored_self = texelFetch(u_CDTexture, texel_base, 0);
    if (!holds_particle(stored_self))
        return false;
    curr_pos = decode_position(stored_self);
#endif
    precise float particle_min_length = 100000.0;
    bool particle_collision = false;
    for (int ty = -u_TexelCollideRange; ty <= u_TexelCollideRange; ++ty) {
        for (int tx = -u_TexelCollideRange; tx <= u_TexelCollideRange; ++tx) {
            ivec2 texel = texel_base + ivec2(tx, ty);
            if ((tx == 0 && ty == 0) || !on_image(texel))
                continue;
            vec4 stored = texelFetch(u_CDTexture, texel, 0);
            if (!holds_particle(stored))
                continue;
            vec3 apart = sum(curr_pos, -decode_position(stored));
            float len = ls_length(apart);
#if ZERO_DISTANCE == ZERO_DISTANCE_SKIP
            if (len == 0.0)
                continue;
#endif
            if (u_CollisionRange > len && len < particle_min_length) {
                particle_min_length = len;
                away = apart;
                particle_collision = true;
            }
        }
    }
    return particle_collision;
}

// The exact preset leaves the rasteriser nothing to round: the point stands on the centre of the texel that the next
// frame will compute for it, at w = 1, its depth on a grid of 2^-24, which survives z * 0.5 + 0.5 unchanged. Points
// outside the view volume are put outside it.
vec4 texel_centre(vec4 clip) {
    ivec2 texel;
    bool visible = base_texel(image_position(clip), texel);
    precise float depth = (ls_divide(clip.z, clip.w) + 1.0) * 0.5;
    if (!visible || !(clip.w > 0.0) || !(depth >= 0.0) || !(depth <= 1.0))
        return vec4(0.0, 0.0, 2.0, 1.0);
    precise vec2 centre = vec2(2 * texel + 1) * vec2(ls_divide(1.0, float(u_ClientWidth)),
                                                     ls_divide(1.0, float(u_ClientHeight))) - 1.0;
    precise float on_grid = floor(depth * 16777216.0) * (1.0 / 16777216.0);
    precise float z = 2.0 * on_grid - 1.0;
    return vec4(centre, z, 1.0);
}

// Lines 21 to 24.
void collide(vec3 away) {
    v_Speed = product(a_Speed, u_SpeedFactor);
    v_Dir = ls_normalize(away);
    v_CollideTime = u_CollisionTime;
    vec3 step = product(v_Dir, v_Speed);
#if COLLISION_STEP == COLLISION_STEP_TICK
    step = product(step, u_Tick);
#endif
    v_Position = sum(a_Position, step);
}

// Lines 26 to 30.
void integrate() {
    vec3 temp = sum(product(a_Dir, a_Speed), product(u_Gravity, u_Tick));
    v_Dir = ls_normalize(temp);
    v_Speed = ls_length(temp);
    precise float collide_time = a_CollideTime - u_Tick;
    v_CollideTime = ls_flush(collide_time);
    v_Position = sum(a_Position, product(product(v_Dir, v_Speed), u_Tick));
}

void main() {
    ivec2 texel_base;
    vec3 away;
    bool visible = base_texel(image_position(ls_transform(u_ProjView, a_Position)), texel_base);
    if (a_CollideTime < 0.0 && visible && nearest_collision(texel_base, away))
        collide(away);
    else
        integrate();
#if RASTER_POSITION == RASTER_POSITION_UPDATED
    vec4 clip = ls_transform(u_ProjView, v_Position);
#else
    vec4 clip = ls_transform(u_ProjView, a_Position);
#endif
#if ARITHMETIC == ARITHMETIC_EXACT
    gl_Position = texel_centre(clip);
#else
    gl_Position = clip;
#endif
}
