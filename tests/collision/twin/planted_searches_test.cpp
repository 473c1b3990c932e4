#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/collision/twin/planted_formulas.hpp"

namespace lockstep::test::planted_searches_test {

using namespace lockstep::test::formulas;

namespace {

const std::string skip = "if ((tx == 0 && ty == 0) || !on_image(texel))\n                continue;";
const std::string skip_own = "if (tx == 0 && ty == 0)\n                continue;\n            ";
const std::string skip_empty = "if (!holds_particle(stored))\n                continue;";
const std::string fetched = "texelFetch(u_CDTexture, texel, 0)";
const std::string offset = "ivec2 texel = texel_base + ivec2(tx, ty);";
const std::string updates = "particle_min_length = len;\n                away = apart;";
const std::string searches = "ls_flush(a_CollideTime) < 0.0 && visible";

Plant planted(const std::string& cause, const std::string& text, const std::string& replacement,
              const std::string& scene = "crowd") {
    return {cause, scene, text, replacement};
}
/// Only who fulfils `condition` searches.
Plant searches_if(const std::string& cause, const std::string& condition) {
    return planted(cause, searches, searches + " && " + condition);
}

std::vector<Plant> left_loops() {
    return {
        planted("row_left_at_border", skip, skip_own + "if (!on_image(texel))\n                break;", "borders"),
        planted("search_left_at_border", skip,
                skip_own + "if (!on_image(texel))\n                return particle_collision;", "borders"),
        planted("row_left_at_empty_texel", skip_empty, "if (!holds_particle(stored))\n                break;"),
        planted("search_left_at_empty_texel", skip_empty,
                "if (!holds_particle(stored))\n                return particle_collision;"),
        planted("row_left_at_own_texel", skip,
                "if (tx == 0 && ty == 0)\n                break;\n            if (!on_image(texel))\n                "
                "continue;"),
        planted(
            "search_left_at_own_texel", skip,
            "if (tx == 0 && ty == 0)\n                return particle_collision;\n            if (!on_image(texel))\n"
            "                continue;"),
        planted("row_left_in_range", updates,
                updates + "\n                particle_collision = true;\n            }\n            if "
                          "(u_CollisionRange > len) {\n                break;"),
        planted("row_left_out_of_range", "if (" + in_range + ")",
                "if (!(u_CollisionRange > len))\n                break;\n            if (" + in_range + ")"),
    };
}

std::vector<Plant> choices() {
    return {
        planted("improving_neighbours_added_up", "away = apart;", "away = sum(away, apart);"),
        planted("improving_units_added_up", "away = apart;", "away = sum(away, ls_normalize(apart));"),
        planted("compared_with_first", "particle_min_length = len;",
                "if (!particle_collision)\n                    particle_min_length = len;"),
        planted("compared_with_one_before",
                "if (" + in_range + ") {\n                " + updates + "\n                particle_collision = true;",
                "if (u_CollisionRange > len) {\n                if (len < particle_min_length)\n                    "
                "away = apart;\n"
                "                particle_min_length = len;\n                particle_collision = true;"),
        planted("distance_as_whole_number", "len < particle_min_length",
                "floor(len * 10.0) < floor(particle_min_length * 10.0)"),
        planted("range_times_a_constant", "u_CollisionRange > len", "u_CollisionRange * 1.5 > len"),
        planted("only_lower_neighbours", in_range, "apart.y > 0.0 && " + in_range),
        planted("receding_hit_ignored", "nearest_collision(texel_base, away))",
                "nearest_collision(texel_base, away) && dot(a_Dir, away) < 0.0)"),
        planted(
            "distance_in_ndc", "float len = ls_length(apart);",
            "vec4 ca = ls_transform(u_ProjView, a_Position), cb = ls_transform(u_ProjView, decode_position(stored));\n"
            "            float len = length(ca.xyz / ca.w - cb.xyz / cb.w);"),
        planted("stored_unpacked_as_normal", "sum(curr_pos, -decode_position(stored))",
                "sum(curr_pos, -(decode_position(stored) * 2.0 - 1.0))"),
        planted("own_position_in_clip_space", "precise vec3 curr_pos = a_Position;",
                "precise vec3 curr_pos = ls_transform(u_ProjView, a_Position).xyz;"),
    };
}

std::vector<Plant> windows() {
    return {
        planted("window_of_even_side", "(tx == 0 && ty == 0)",
                "tx == u_TexelCollideRange || ty == u_TexelCollideRange || (tx == -u_TexelCollideRange && ty == 0)"),
        planted("index_of_even_side", "(tx == 0 && ty == 0)",
                "(tx == 0 && ty == 0) || (ty + u_TexelCollideRange) * (2 * u_TexelCollideRange + 1) + tx + "
                "u_TexelCollideRange >= 4 * u_TexelCollideRange * u_TexelCollideRange"),
        planted("texel_above_skipped_for_own", "(tx == 0 && ty == 0)", "(tx == 0 && ty == 1)"),
        planted("last_texel_left_out", "(tx == 0 && ty == 0)",
                "(tx == 0 && ty == 0) || (tx == u_TexelCollideRange && ty == u_TexelCollideRange)"),
        planted("corners_left_out", "(tx == 0 && ty == 0)",
                "(tx == 0 && ty == 0) || (abs(tx) == u_TexelCollideRange && abs(ty) == u_TexelCollideRange)"),
        planted("offsets_halved", offset, "ivec2 texel = texel_base + ivec2(tx, ty) / 2;"),
        planted("rows_read_base_row", offset, "ivec2 texel = texel_base + ivec2(tx, 0);"),
        planted("texel_after_read", offset, "ivec2 texel = texel_base + ivec2(tx + 1, ty);"),
        planted("beyond_tile_skipped", "!on_image(texel)", "!on_image(texel) || texel / 16 != texel_base / 16"),
        searches_if("only_falling_search", "a_Dir.y < 0.0"),
        searches_if("some_do_not_search", "gl_VertexID % 4 != 0"),
        searches_if("only_fast_search", "a_Speed > 2.0"),
        planted("only_x_divided", "image_position(ls_transform(u_ProjView, a_Position))",
                "image_position(ls_transform(u_ProjView, a_Position) * vec2(1.0, ls_transform(u_ProjView, "
                "a_Position).w).xyxx * vec4(1.0, 1.0, 0.0, 0.0) + vec4(0.0, 0.0, 0.0, ls_transform(u_ProjView, "
                "a_Position).w))"),
    };
}

std::vector<Plant> answers() {
    return {
        planted("direction_from_texels", "away = apart;", "away = -vec3(tx, ty, 0.0);"),
        after_hit("dominant_axis_at_hit",
                  "vec3 s = abs(away); v_Dir = s.x >= s.y && s.x >= s.z ? vec3(sign(away.x), 0.0, 0.0) : s.y >= s.z ? "
                  "vec3(0.0, sign(away.y), 0.0) : vec3(0.0, 0.0, sign(away.z)); " +
                      moved),
        after_hit("fast_inverse_root_at_hit",
                  "float d = dot(away, away); float q = intBitsToFloat(0x5f3759df - (floatBitsToInt(d) >> 1)); "
                  "q = q * (1.5 - 0.5 * d * q * q); v_Dir = away * q; " +
                      moved),
        after_hit("speed_by_angle", "v_Speed = v_Speed * max(0.0, -dot(a_Dir, v_Dir)); " + moved),
        after_hit("speed_at_least_at_hit", "v_Speed = max(v_Speed, 4.0); " + moved),
        after_hit("bounces_by_factor",
                  "vec3 n = ls_normalize(away), u = a_Dir * a_Speed, b = u - (1.0 + u_SpeedFactor) * dot(u, n) * n; "
                  "v_Dir = normalize(b); v_Speed = length(b); " +
                      moved),
        after_hit("velocity_stored_as_direction_at_hit", "v_Dir = product(v_Dir, v_Speed);"),
        after_hit("moves_on_before_hit", "v_Position = v_Position + a_Dir * a_Speed * u_Tick;"),
        after_fall("collide_time_counted_above_zero", "if (!(a_CollideTime > 0.0)) v_CollideTime = a_CollideTime;"),
        after_fall("held_until_it_searches", "if (!(a_CollideTime < 0.0)) v_Position = a_Position;"),
        {"length_of_direction_stored_as_speed", "crowd", "out_Speed = v_Speed[0];", "out_Speed = length(v_Dir[0]);",
         "collision_pass.geom"},
        planted("positions_added", "sum(curr_pos, -decode_position(stored))", "sum(curr_pos, decode_position(stored))",
                "origin"),
        after_fall("move_by_direction_alone", "v_Position = sum(a_Position, product(v_Dir, u_Tick));"),
        after_fall("drag_by_tick", "v_Speed = v_Speed * (1.0 - 0.5 * u_Tick); v_Position = sum(a_Position, "
                                   "product(product(v_Dir, v_Speed), u_Tick));"),
        planted("position_in_ndc", "    vec4 clip = ls_transform(u_ProjView, v_Position);\n",
                "    vec4 clip = ls_transform(u_ProjView, v_Position);\n    v_Position = clip.xyz / clip.w;\n"),
    };
}

} // namespace

TEST_CASE("planted searches: loops that are left are told by their names") { check_told(left_loops()); }

TEST_CASE("planted searches: choices among neighbours are told by their names") { check_told(choices()); }

TEST_CASE("planted searches: windows, and who searches, are told by their names") { check_told(windows()); }

TEST_CASE("planted searches: answers and falls are told by their names") { check_told(answers()); }

} // namespace lockstep::test::planted_searches_test
