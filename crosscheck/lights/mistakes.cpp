#include "crosscheck/lights/mistakes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "reference/lights/light_order.hpp"
#include "reference/lights/sites.hpp"

namespace lockstep::lights {
namespace {

using Words = std::span<float>;

Mistake spoiled_at(const Site& site, Formula formula) {
    return {.site = site.id, .change = Change::spoiled, .formula = formula};
}

Mistake fewer(FewerTried which) { return {.change = Change::handed_over, .part = static_cast<int>(which)}; }

float first(const CameBy& run, const Site& site) { return run.of(site)[0]; }

void falloff_by_share(Words value, const CameBy& run) { value[0] = 1.0F - first(run, site::ratio); }
void falloff_not_squared(Words value, const CameBy& run) {
    value[0] = first(run, site::falloff) / first(run, site::denominator);
}
void red_is_green(Words value, const CameBy& /*run*/) { value[0] = value[1]; }
void magnitude(Words value, const CameBy& /*run*/) { value[0] = std::abs(value[0]); }
void z_of_direction(Words value, const CameBy& run) { value[0] = run.of(site::light_direction)[2]; }
void red_of_colour(Words value, const CameBy& run) { value[0] = first(run, site::light_colour); }
void unsigned_word(Words value, const CameBy& /*run*/) {
    if (value[0] < 0.0F)
        value[0] = static_cast<float>(double{value[0]} + 0x1p32);
}
void offset_by_constant(Words value, const CameBy& run) { value[0] -= run.constants[0]; }
void ambient_shaded(Words value, const CameBy& run) {
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = run.of(site::albedo)[c] *
                   ((run.of(site::ambient)[c] + run.of(site::sampled_colour)[c]) * first(run, site::diffuse));
}
void cross_product(Words value, const CameBy& run) {
    const auto& cross = run.of(site::normal_sum);
    const float along = value[0] * cross[0] + value[1] * cross[1] + value[2] * cross[2];
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = along < 0.0F ? -cross[c] : cross[c];
}
void at_most_127(Words value, const CameBy& /*run*/) { value[0] = std::min(value[0], 127.0F); }
/// Wherever the pixels lie that are drawn for a disc (shaders/pixel_box.glsl).
void in_box_of_disc(Words value, const CameBy& run) {
    const float reach = first(run, site::glow_radius) + 0.0625F;
    const bool in_box = std::abs(first(run, site::centre_x) - first(run, site::glow_x)) <= reach &&
                        std::abs(first(run, site::centre_y) - first(run, site::glow_y)) <= reach;
    value[0] = in_box ? 1.0F : 0.0F;
}
/// Of discs about a place half a pixel aside: no more pixels are drawn.
void in_box_of_disc_beside(Words value, const CameBy& run) {
    const float centre = first(run, site::centre_x) + 0.5F;
    if (std::abs(centre - first(run, site::glow_x)) > first(run, site::glow_radius) + 0.0625F)
        value[0] = 0.0F;
}
void of_area(Words value, const CameBy& /*run*/) {
    const float side = std::cbrt(value[0]);
    value[0] = side * side;
}
void by_255(Words value, const CameBy& /*run*/) {
    for (float& x : value)
        x = x * 256.0F / 255.0F;
}

/// Wherever lights are added up.
std::vector<NamedMistake> of_volumes() {
    static const Mistake z = spoiled_at(site::sum_z, magnitude);
    static const Mistake yz = [] {
        Mistake two = spoiled_at(site::sum_y, magnitude);
        two.also = &z;
        return two;
    }();
    Mistake magnitudes = spoiled_at(site::sum_x, magnitude);
    magnitudes.also = &yz;
    std::vector<NamedMistake> all;
    for (const char* const pass : {"light_volume_scatter", "light_volume_gather", "light_volume_gather_direction",
                                   "light_volume_blend", "light_volume_blend_direction"}) {
        const auto add = [&](const char* name, const char* meaning, const Mistake& mistake) {
            all.push_back({name, meaning, pass, mistake});
        };
        add("direction_to_voxel", "the direction is from the light to the voxel",
            mistake_at(site::light_direction, Change::negated));
        add("corner_for_centre", "a voxel's point is its corner", mistake_at(site::offset, Change::zero));
        add("x_and_z_swapped", "a voxel's x is taken for its z", mistake_at(site::voxel_point, Change::xz_swapped));
        add("origin_ignored", "a voxel's point is taken from the world's origin, not the grid's",
            mistake_at(site::low, Change::zero));
        add("range_excluded", "at its very range a light does not reach",
            mistake_at(site::in_range, Change::or_equal, 0));
        add("range_not_squared", "the squared distance is compared with the range",
            mistake_at(site::range2, Change::instead, -1, &site::range_before));
        add("weights_not_added", "the sum of weights stays 0", mistake_at(site::sum_weight, Change::zero));
        add("z_not_added", "the sum of z stays 0", mistake_at(site::sum_z, Change::zero));
        add("range_ignored", "a light reaches beyond its range", mistake_at(site::in_range, Change::always));
        add("own_voxel_only", "a light reaches its own voxel alone", mistake_at(site::by_own_voxel, Change::always));
        add("falloff_by_share", "the window is of the squared share, not of its square",
            spoiled_at(site::falloff, falloff_by_share));
        add("falloff_not_squared", "the window is not squared", spoiled_at(site::attenuation, falloff_not_squared));
        add("distance_without_one", "the window is divided by s, not s + 1",
            mistake_at(site::denominator, Change::instead, -1, &site::squared));
        add("attenuation_without_distance", "the window is not divided by the distance",
            mistake_at(site::attenuation, Change::not_done));
        add("colour_not_attenuated", "a light's colour is added whole",
            mistake_at(site::light_colour, Change::instead, -1, &site::colour_before));
        add("direction_not_unit", "directions are as long as the vector to the light",
            mistake_at(site::unit, Change::instead, -1, &site::to_light));
        add("direction_by_square", "the vector to the light is divided by its squared length",
            mistake_at(site::distance, Change::not_done));
        add("direction_not_weighted", "directions are not weighted", mistake_at(site::weight, Change::one));
        add("direction_weighted_twice", "directions are weighted twice",
            mistake_at(site::light_direction, Change::times, -1, &site::attenuation));
        add("weight_is_one", "the sum of weights is a count", mistake_at(site::sum_weight, Change::one));
        add("point_guard_missing", "a light on the voxel's point has a direction",
            mistake_at(site::on_the_point, Change::never));
        add("never_counted", "lights are not counted", mistake_at(site::one_more, Change::zero));
        add("counted_twice", "each light is counted twice", mistake_at(site::one_more, Change::doubled));
        add("light_colour_red_is_green", "green is added to red", spoiled_at(site::light_colour, red_is_green));
        add("x_sum_of_z", "z is added to the sum of x", spoiled_at(site::sum_x, z_of_direction));
        add("weight_of_red", "red is added to the sum of weights", spoiled_at(site::sum_weight, red_of_colour));
        add("magnitudes_added", "negative numbers are added as positive ones", magnitudes);
        add("y_of_x", "a voxel's x is taken for its y", mistake_at(site::voxel_y, Change::instead, -1, &site::voxel_x));
        add("ball_cut_short", "voxels at the far side of a light's ball are left out", fewer(FewerTried::two_short));
        add("own_column_only", "of a light's ball only the voxels of its own x are tried",
            fewer(FewerTried::own_column));
        add("next_rows_only", "lights of cells more than one below are left out", fewer(FewerTried::next_rows));
        add("next_layers_only", "lights of cells more than one before are left out", fewer(FewerTried::next_layers));
        add("rounded_down", "addends are rounded down", mistake_at(site::half_unit, Change::zero));
        add("last_light_left_out", "the last light is left out", mistake_at(site::all_lights, Change::last_skipped));
        add("scale_doubled", "the scale of fixed point has a bit too many",
            mistake_at(site::fixed_scale, Change::doubled));
    }
    return all;
}

/// Wherever a point is lit.
std::vector<NamedMistake> of_lighting() {
    std::vector<NamedMistake> all;
    for (const char* const pass : {"deferred_light_pass", "forward_light_pass"}) {
        const auto add = [&](const char* name, const char* meaning, const Mistake& mistake) {
            all.push_back({name, meaning, pass, mistake});
        };
        add("fraction_not_reduced", "the whole texels stay in the weights",
            mistake_at(site::fraction, Change::plus, -1, &site::base));
        add("half_texel_missing", "texels are taken to lie at their corners",
            mistake_at(site::half_texel, Change::zero));
        add("lerp_turned", "the two texels' weights are swapped", mistake_at(site::fraction, Change::opposite));
        add("supersample_without_half", "samples lie behind the point, not around it",
            mistake_at(site::sample_offset, Change::half_more));
        all.push_back({.name = "supersample_corners",
                       .meaning = "samples lie at corners of their parts, not in the middle",
                       .pass = pass,
                       .mistake = spoiled_at(site::sample_offset, offset_by_constant),
                       .constants = {{0.25F}, {0.125F}}});
        add("supersample_sum", "samples are added up, not averaged", mistake_at(site::sample_mean, Change::one));
        add("supersample_of_area", "the sum of the samples is divided by their number in a plane",
            spoiled_at(site::sample_mean, of_area));
        add("outside_clamped", "outside the grid its border's values go on", mistake_at(site::in_grid, Change::always));
        add("colour_of_direction", "the texture of directions is read for colours",
            mistake_at(site::sampled_colour, Change::instead, -1, &site::sampled_direction));
        add("length_not_rooted", "the direction is divided by its squared length",
            mistake_at(site::direction_length, Change::not_done));
        add("albedo_ignored", "surfaces are white", mistake_at(site::albedo, Change::one));
        add("grid_at_world_origin", "textures are sampled as if the grid began at the world's origin",
            mistake_at(site::low, Change::zero));
        add("cubic_base_late", "the four texels along each axis begin one late",
            mistake_at(site::first_texel, Change::one_more));
        add("cubic_not_clamped", "a negative colour stays", mistake_at(site::not_below, Change::never));
        add("lambert_not_clamped", "light from behind darkens", mistake_at(site::faces_light, Change::never));
        add("direction_not_normalised", "the sampled direction is not normalised",
            mistake_at(site::to_lights, Change::instead, -1, &site::sampled_direction));
        add("ambient_missing", "there is no ambient light", mistake_at(site::ambient, Change::zero));
        add("ambient_shaded", "ambient light is shaded as light from the lights is",
            spoiled_at(site::radiance, ambient_shaded));
        add("place_in_metres", "textures are sampled in metres, not voxels", mistake_at(site::inv_voxel, Change::one));
        add("gbuffer_validity_ignored", "what is nowhere is lit", mistake_at(site::is_valid, Change::always));
        add("albedo_by_255", "codes of the albedo are divided by 255", spoiled_at(site::albedo, by_255));
        add("normal_of_position", "the position is taken for the normal",
            mistake_at(site::surface_normal, Change::instead, -1, &site::surface_point));
    }
    return all;
}

} // namespace

const std::vector<NamedMistake>& mistakes() {
    static const std::vector<NamedMistake> all = [] {
        static const Mistake drawn{
            .site = site::on_disc.id, .change = Change::decided_by_formula, .formula = in_box_of_disc_beside};
        Mistake beside = mistake_at(site::centre_x, Change::half_less);
        beside.also = &drawn;
        std::vector<NamedMistake> made{
            {"step_without_tick", "in each frame lights move as far as in a second", "light_step_pass",
             mistake_at(site::tick, Change::one)},
            {"step_without_speed", "every light goes 1 m a second", "light_step_pass",
             mistake_at(site::speed_before, Change::one)},
            {"bounce_keeps_direction", "at a wall a light keeps its direction", "light_step_pass",
             mistake_at(site::turned, Change::negated)},
            {"stops_at_lower_wall", "at a lower wall a light stops", "light_step_pass",
             mistake_at(site::mirrored_low, Change::instead, -1, &site::wall_low)},
            {"upper_wall_missing", "at an upper wall a light stops, and keeps its direction", "light_step_pass",
             mistake_at(site::above, Change::never)},
            {"steps_backwards", "lights go backwards", "light_step_pass", mistake_at(site::step, Change::negated)},
            {"light_stays", "lights stay where they are", "light_step_pass",
             mistake_at(site::position, Change::instead, -1, &site::before)},
            {.name = "step_left_out",
             .meaning = "lights are as in the frame before",
             .pass = "light_step_pass",
             .mistake = {.change = Change::item_kept}},
            {"clear_left_out", "the accumulator keeps what the frame before left", "light_volume_clear",
             mistake_at(site::is_cleared, Change::never)},
            {"carries_lost", "carries between the words of a sum are lost", "light_volume_scatter",
             mistake_at(site::carries, Change::never)},
            {"carry_always", "a carry is added whether there is one or not", "light_volume_scatter",
             mistake_at(site::always_carries, Change::always)},
            {"cleared_to_one", "the accumulator starts from 1", "light_volume_clear",
             mistake_at(site::cleared, Change::one)},
            {"count_of_weights", "the count is the sum of weights", "light_volume_resolve",
             mistake_at(site::count_word, Change::never)},
            {"row_starts_late", "a row of cells begins behind its own lights", "light_sort_pass",
             mistake_at(site::cell_start, Change::instead, -1, &site::row_end)},
            {"cell_counts_twice", "each light of a cell is counted twice", "light_sort_pass",
             mistake_at(site::cell_count, Change::doubled)},
            {"borrows_lost", "the high word of a negative number is one too great", "light_volume_scatter",
             mistake_at(site::borrows, Change::never)},
            {"albedo_turned", "red and blue of the albedo are swapped", "gbuffer_pass_albedo",
             mistake_at(site::albedo, Change::xz_swapped)},
            {"depth_turned", "depth is stored from the far plane", "gbuffer_pass_depth",
             mistake_at(site::depth, Change::opposite)},
            {"normal_of_position", "the position is stored as the normal", "gbuffer_pass_normal",
             mistake_at(site::surface_normal, Change::instead, -1, &site::surface_point)},
            {"normal_never_turned", "normals face as their triangle does, not the viewer", "gbuffer_pass_normal",
             mistake_at(site::faces_away, Change::never)},
            {"normal_turned_away", "normals are turned from the viewer", "gbuffer_pass_normal",
             mistake_at(site::faces_away, Change::inverted)},
            {"normal_not_unit", "normals are as long as the triangle is large", "gbuffer_pass_normal",
             spoiled_at(site::surface_normal, cross_product)},
            {"glow_through_walls", "glows are seen through what is before them", "glow_pass",
             mistake_at(site::glow_nearer, Change::always)},
            {"glow_square",
             "glows are as large as what is drawn for them",
             "glow_pass",
             {.site = site::on_disc.id, .change = Change::decided_by_formula, .formula = in_box_of_disc}},
            {"glow_by_corner", "discs are measured from the corners of pixels", "glow_pass", beside},
            {"glow_without_gain", "glows are not multiplied by their gain", "glow_pass",
             mistake_at(site::glow_gain, Change::one)},
            {"glow_not_fading", "glows are even discs", "glow_pass", mistake_at(site::glow_share, Change::one)},
        };
        for (const char* const pass : {"light_volume_resolve", "light_volume_resolve_direction"})
            made.insert(made.end(), {{"high_word_unsigned", "negative sums are read as great ones", pass,
                                      spoiled_at(site::high_word, unsigned_word)},
                                     {"low_word_lost", "sums are cut to whole numbers", pass,
                                      mistake_at(site::low_word, Change::zero)},
                                     {"words_swapped", "the two words of a sum are swapped", pass,
                                      mistake_at(site::low_first, Change::never)}});
        for (const char* const pass : {"gbuffer_pass", "gbuffer_pass_normal", "gbuffer_pass_albedo",
                                       "gbuffer_pass_depth", "forward_light_pass", "forward_light_pass_depth"})
            made.push_back({"first_triangle_stays", "the triangle that is drawn first stays, whatever its depth", pass,
                            mistake_at(site::nearest, Change::first_taken)});
        for (const char* const pass : {"encode_pass", "encode_by_gl_pass"}) {
            made.push_back({"encoded_turned", "red and blue are swapped", pass,
                            mistake_at(site::radiance_in, Change::xz_swapped)});
            made.push_back(
                {"half_of_the_table", "codes above 127 become 127", pass, spoiled_at(site::code, at_most_127)});
            made.push_back(
                {"code_cut", "codes are cut, not rounded", pass, mistake_at(site::code_value, Change::half_less)});
        }
        for (std::vector<NamedMistake>& more : std::vector{of_volumes(), of_lighting()})
            made.insert(made.end(), more.begin(), more.end());
        return made;
    }();
    return all;
}

} // namespace lockstep::lights
