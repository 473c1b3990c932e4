#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/collision/twin/planted_formulas.hpp"

namespace lockstep::test::planted_formulas_test {

using namespace lockstep::test::formulas;

namespace {

const std::string stays = "v_Position = a_Position; v_Dir = a_Dir; v_Speed = a_Speed;";

std::vector<Plant> plants() {
    return {
        skips("half_stencil_searched", "ty < 0 || (ty == 0 && tx <= 0)"),
        skips("lower_triangle_searched", "(tx == 0 && ty == 0) || tx > ty"),
        skips("eight_texels_searched", "(tx == 0 && ty == 0) || (tx & 1) != 0 || (ty & 1) != 0"),
        skips("next_texel_skipped_for_own", "tx == 1 && ty == 0"),
        {"base_texel_of_last_rounded", "crowd", "ivec2 texel = texel_base + ivec2(tx, ty);",
         "ivec2 texel = ivec2(round(image_position(ls_transform(u_ProjView, a_Position)) / vec2(u_ClientWidth, "
         "u_ClientHeight) * vec2(u_ClientWidth - 1, "
         "u_ClientHeight - 1))) + ivec2(tx, ty);"},
        {"nearest_of_last_row", "crowd", "for (int tx = -u_TexelCollideRange;",
         "particle_min_length = 100000.0;\n        for (int tx = -u_TexelCollideRange;"},
        after_hit("old_direction_kept_in_part", "v_Dir = normalize(v_Dir + 0.5 * a_Dir); " + moved),
        {"offsets_doubled", "crowd", "ivec2 texel = texel_base + ivec2(tx, ty);",
         "ivec2 texel = texel_base + 2 * ivec2(tx, ty);"},
        after_hit("length_with_epsilon_at_hit", "v_Dir = away / (length(away) + 0.001); " + moved),
        after_fall(
            "length_with_epsilon",
            "vec3 v = sum(product(a_Dir, a_Speed), product(u_Gravity, u_Tick)); v_Dir = v / (length(v) + 0.001); "
            "v_Position = sum(a_Position, product(product(v_Dir, v_Speed), u_Tick));"),
        after_fall("stored_speed_at_least", "v_Speed = max(v_Speed, 1.0);"),
        after_fall("collide_time_at_least", "v_CollideTime = max(v_CollideTime, -0.01);"),
        {"any_zero_is_empty", "near_ties", "return stored.a != 0.0;",
         "return stored.x != 0.0 && stored.y != 0.0 && stored.z != 0.0;"},
        {"base_texel_even", "crowd", "ivec2 texel = texel_base + ivec2(tx, ty);",
         "ivec2 texel = (texel_base & ~1) + ivec2(tx, ty);"},
        {"fetched_at_half_resolution", "crowd", "vec4 stored = texelFetch(u_CDTexture, texel, 0);",
         "vec4 stored = texelFetch(u_CDTexture, texel & ~1, 0);"},
        {"half_resolution", "crowd", "ivec2 texel = texel_base + ivec2(tx, ty);",
         "if (((tx | ty) & 1) != 0) continue;\n            ivec2 texel = (texel_base & ~1) + ivec2(tx, ty);"},
        {"close_neighbours_skipped", "crowd", in_range, "len > 0.25 && " + in_range},
        least("nearest_in_x_and_y", "crowd", "length(apart.xy)"),
        least("nearest_in_z", "crowd", "abs(apart.z)"),
        least("nearest_to_camera", "crowd", w_of_neighbour),
        least("farthest_from_camera", "crowd", "-" + w_of_neighbour),
        least("nearest_in_camera_depth", "crowd", "abs(" + w_of_neighbour + " - " + w_of_own + ")"),
        {"range_times_w", "crowd", in_range, "u_CollisionRange * " + w_of_own + " > len && len < particle_min_length"},
        {"range_over_w", "crowd", in_range, "u_CollisionRange / " + w_of_own + " > len && len < particle_min_length"},
        after_hit("pushed_by_range", "v_Position = sum(a_Position, product(v_Dir, u_CollisionRange));"),
        after_hit("pushed_by_distance", "v_Position = sum(a_Position, away);"),
        after_hit("falls_after_hit_too",
                  "vec3 v = sum(product(v_Dir, v_Speed), product(u_Gravity, u_Tick)); v_Dir = ls_normalize(v); "
                  "v_Speed = ls_length(v); v_CollideTime = v_CollideTime - u_Tick; "
                  "v_Position = sum(v_Position, product(v, u_Tick));"),
        after_hit("speed_less_factor_at_hit", "v_Speed = a_Speed - u_SpeedFactor; " + moved),
        after_hit("upwards_at_hit", "v_Dir = vec3(0.0, 1.0, 0.0); " + moved),
        after_hit("against_gravity_at_hit", "v_Dir = -normalize(u_Gravity); " + moved),
        after_hit("away_from_origin_at_hit", "v_Dir = ls_normalize(a_Position); " + moved),
        {"gravity_halved", "crowd", "product(u_Gravity, u_Tick)", "product(u_Gravity, 0.5 * u_Tick)"},
        after_fall("collide_time_set_by_every_search", "if (a_CollideTime < 0.0) v_CollideTime = u_CollisionTime;"),
        after_fall("collide_time_is_zero_after_search", "if (a_CollideTime < 0.0) v_CollideTime = 0.0;"),
        after_fall("no_fall_after_missed_search",
                   "if (a_CollideTime < 0.0) { " + stays + " v_CollideTime = a_CollideTime; }"),
        after_fall("no_fall_after_missed_search_but_counts", "if (a_CollideTime < 0.0) { " + stays + " }"),
        after_fall("rests_while_collide_time_runs",
                   "if (a_CollideTime >= 0.0) { " + stays + " v_CollideTime = a_CollideTime; }"),
        after_fall("moves_only_when_searching", "if (a_CollideTime >= 0.0) { " + stays + " }"),
    };
}

/// The point is drawn at `place`, of the clip position c.
Plant point(const std::string& cause, const std::string& scene, const std::string& place) {
    return {cause, scene, "gl_Position = point_position(clip);",
            "precise vec4 c = clip;\n    precise vec4 p = " + place + ";\n    gl_Position = point_position(p);"};
}
Plant stored(const std::string& cause, const std::string& value) {
    return {cause, "crowd", "o_Texel = encode_position(out_Position);", value, "collision_pass.frag"};
}
Plant obstacle(const std::string& cause, const std::string& text, const std::string& replacement) {
    return {cause, "crowd", text, replacement, "obstacle_pass.frag"};
}
std::string corners(const std::string& all) { return "interpolate(vec3[3](" + all + "), fragment.shares)"; }

std::vector<Plant> drawing_plants() {
    const std::string mixed = "interpolate(g_Position, fragment.shares)";
    return {
        point("point_flat", "crowd", "vec4(c.xy / c.w, 0.0, 1.0)"),
        point("point_half_pixel_lower", "crowd", "vec4(c.x, c.y - c.w * (1.0 / float(u_ClientHeight)), c.zw)"),
        point("point_x_flipped", "crowd", "vec4(-c.x, c.yzw)"),
        point("point_x_and_y_swapped", "crowd", "c.yxzw"),
        point("point_pixel_right", "crowd", "vec4(c.x + c.w * (2.0 / float(u_ClientWidth)), c.yzw)"),
        point("point_pixel_down", "crowd", "vec4(c.x, c.y - c.w * (2.0 / float(u_ClientHeight)), c.zw)"),
        point("point_depth_zero_to_one", "crowd", "vec4(c.xy, (c.z + c.w) * 0.5, c.w)"),
        point("point_depth_doubled", "crowd", "vec4(c.xy, 2.0 * c.z - c.w, c.w)"),
        point("point_depth_clamped", "wide_and_fast", "vec4(c.xy, c.w > 0.0 ? clamp(c.z, -c.w, c.w) : c.z, c.w)"),
        point("near_half_discarded", "crowd", "c.z < 0.0 ? vec4(2.0, 0.0, 0.0, 1.0) : c"),
        stored("stores_negated", "o_Texel = encode_position(-out_Position);"),
        stored("stores_z_negated", "o_Texel = encode_position(vec3(out_Position.xy, -out_Position.z));"),
        stored("stores_remapped", "o_Texel = encode_position(out_Position * 0.5 + 0.5);"),
        stored("checkerboard_discarded", "ivec2 p = ivec2(gl_FragCoord.xy); if (((p.x + p.y) & 1) != 0) discard;\n"
                                         "    o_Texel = encode_position(out_Position);"),
        stored("stores_window_coordinates", "o_Texel = encode_position(gl_FragCoord.xyz);"),
        stored("stores_in_steps", "o_Texel = encode_position(round(out_Position * 256.0) / 256.0);"),
        point("only_upper_right_drawn", "crowd", "c.x < 0.0 || c.y < 0.0 ? vec4(2.0, 0.0, 0.0, 1.0) : c"),
        point("point_shift_without_w", "crowd",
              "vec4(c.xy + vec2(1.0 / float(u_ClientWidth), 1.0 / float(u_ClientHeight)), c.zw)"),
        obstacle("obstacle_depth_reversed", "gl_FragDepth = fragment.depth", "gl_FragDepth = 1.0 - fragment.depth"),
        stored("fragment_depth_zero", "o_Texel = encode_position(out_Position);\n    gl_FragDepth = 0.0;"),
        obstacle("obstacle_first_and_second_swapped", mixed, corners("g_Position[1], g_Position[0], g_Position[2]")),
        obstacle("obstacle_second_and_third_swapped", mixed, corners("g_Position[0], g_Position[2], g_Position[1]")),
        obstacle("obstacle_first_and_third_swapped", mixed, corners("g_Position[2], g_Position[1], g_Position[0]")),
        obstacle("obstacle_corners_rotated", mixed, corners("g_Position[1], g_Position[2], g_Position[0]")),
        obstacle("obstacle_centroid_alone", mixed, "(g_Position[0] + g_Position[1] + g_Position[2]) / 3.0"),
        obstacle("obstacle_stores_clip_space", mixed, corners("g_Clip[0].xyz, g_Clip[1].xyz, g_Clip[2].xyz")),
        obstacle("obstacle_stores_ndc", mixed,
                 corners("g_Clip[0].xyz / g_Clip[0].w, g_Clip[1].xyz / g_Clip[1].w, g_Clip[2].xyz / g_Clip[2].w")),
        obstacle("obstacle_depth_zero", "gl_FragDepth = fragment.depth", "gl_FragDepth = 0.0"),
        obstacle("obstacle_first_corner_alone", mixed, "g_Position[0]"),
        obstacle("obstacle_last_corner_alone", mixed, "g_Position[2]"),
        {"obstacle_at_pixel_corner", "crowd", "vec2(2 * pixel + 1 - size)", "vec2(2 * pixel - size)",
         "triangle_interpolation.glsl"},
        obstacle("obstacle_interpolated_on_screen", "triangle_fragment(g_Clip,",
                 "triangle_fragment(vec4[3](g_Clip[0] / g_Clip[0].w, g_Clip[1] / g_Clip[1].w, g_Clip[2] / "
                 "g_Clip[2].w),"),
        obstacle("obstacle_depth_not_halved", "gl_FragDepth = fragment.depth",
                 "gl_FragDepth = max(2.0 * fragment.depth - 1.0, 0.0)"),
    };
}

} // namespace

TEST_CASE("planted formulas: each of the step is told by its name") { check_told(plants()); }

TEST_CASE("planted formulas: each of what is drawn is told by its name") { check_told(drawing_plants()); }

} // namespace lockstep::test::planted_formulas_test
