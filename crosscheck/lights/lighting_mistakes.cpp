#include "crosscheck/lights/lighting_mistakes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "crosscheck/lights/mistake_words.hpp"
#include "reference/lights/sites.hpp"

namespace lockstep::lights {
namespace {

void offset_by_constant(Words value, const CameBy& run) { value[0] -= run.constants[0]; }
void ambient_shaded(Words value, const CameBy& run) {
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = run.of(site::albedo)[c] *
                   ((run.of(site::ambient)[c] + run.of(site::sampled_colour)[c]) * first(run, site::diffuse));
}
void of_area(Words value, const CameBy& /*run*/) {
    const float side = std::cbrt(value[0]);
    value[0] = side * side;
}
void by_255(Words value, const CameBy& /*run*/) {
    for (float& x : value)
        x = x * 256.0F / 255.0F;
}
template <const Site& by> void divided(Words value, const CameBy& run) {
    const float divisor = first(run, by);
    for (float& x : value)
        x = divisor > 0.0F ? x / divisor : x;
}
void by_weights(Words value, const CameBy& run) {
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = run.of(site::sampled_direction)[c] / first(run, site::sampled_weight);
}
void light_without_albedo(Words value, const CameBy& run) {
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = run.of(site::albedo)[c] * run.of(site::ambient)[c] +
                   run.of(site::sampled_colour)[c] * first(run, site::diffuse);
}
void at_least_ambient(Words value, const CameBy& run) {
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = run.of(site::albedo)[c] *
                   std::max(run.of(site::ambient)[c], run.of(site::sampled_colour)[c] * first(run, site::diffuse));
}
void stepped(Words value, const CameBy& /*run*/) { value[0] = value[0] > 0.0F ? 1.0F : 0.0F; }
void cosine_without_z(Words value, const CameBy& run) {
    const auto &n = run.of(site::surface_normal), &l = run.of(site::to_lights);
    value[0] = n[0] * l[0] + n[1] * l[1];
}
void whole(Words value, const CameBy& /*run*/) {
    for (float& x : value)
        x = std::floor(x);
}
void on_diagonal(Words value, const CameBy& run) {
    const auto& middle = run.of(site::grid_place);
    const float offset = value[0] - middle[0];
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = middle[c] + offset;
}
void smoothed(Words value, const CameBy& /*run*/) {
    for (float& f : value)
        f = f * f * (3.0F - 2.0F * f);
}
void by_power(Words value, const CameBy& /*run*/) {
    for (float& x : value)
        x = std::pow(x, 2.2F);
}
void yz_swapped(Words value, const CameBy& /*run*/) { std::swap(value[1], value[2]); }
void xz_swapped(Words value, const CameBy& /*run*/) { std::swap(value[0], value[2]); }
void of_side(Words value, const CameBy& /*run*/) { value[0] = std::cbrt(value[0]); }
void texel_cut(Words value, const CameBy& run) { value[0] = std::trunc(first(run, site::texel_place)); }
void rounded(Words value, const CameBy& run) { value[0] = std::floor(first(run, site::texel_place) + 0.5F); }
void b_spline(Words value, const CameBy& run) {
    const float f = first(run, site::weighed), rest = 1.0F - f;
    value[0] = rest * rest * rest / 6.0F;
    value[1] = (4.0F - 6.0F * f * f + 3.0F * f * f * f) / 6.0F;
    value[2] = (4.0F - 6.0F * rest * rest + 3.0F * rest * rest * rest) / 6.0F;
    value[3] = f * f * f / 6.0F;
}
void of_both_sides(Words value, const CameBy& run) { value[0] = std::abs(first(run, site::cosine)); }
void moved_to_0_1(Words value, const CameBy& run) { value[0] = first(run, site::cosine) * 0.5F + 0.5F; }
void turned_share(Words value, const CameBy& /*run*/) { value[0] = 1.0F - value[0]; }
void from_0_to_1(Words value, const CameBy& /*run*/) {
    for (float& x : value)
        x = x * 2.0F - 1.0F;
}
void ambient_without_albedo(Words value, const CameBy& run) {
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = run.of(site::ambient)[c] +
                   run.of(site::albedo)[c] * (run.of(site::sampled_colour)[c] * first(run, site::diffuse));
}

} // namespace

std::vector<NamedMistake> lighting_mistakes() {
    static const Mistake own_direction = mistake_at(site::own_direction, Change::never);
    std::vector<NamedMistake> all;
    for (const char* const pass : {"deferred_light_pass", "forward_light_pass"}) {
        const auto add = [&](const char* name, const char* meaning, const Mistake& mistake) {
            all.push_back({name, meaning, pass, mistake});
        };
        add("fraction_not_reduced", "the whole texels stay in the weights",
            mistake_at(site::fraction, Change::plus, -1, &site::base));
        add("half_texel_missing", "texels are taken to lie at their corners",
            mistake_at(site::half_texel, Change::zero));
        add("half_texel_missing", "texels are taken to lie at their corners",
            mistake_at(site::half_texel_of_four, Change::zero));
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
        add("gbuffer_validity_ignored", "what is nowhere is lit as black surfaces are, or has no background",
            mistake_at(site::is_valid, Change::always));
        add("albedo_by_255", "codes of the albedo are divided by 255", formula_at(site::albedo, by_255));
        add("normal_of_position", "the position is taken for the normal",
            mistake_at(site::surface_normal, Change::instead, -1, &site::surface_point));
        add("half_texel_added", "half a texel is added, not taken away", mistake_at(site::half_texel, Change::negated));
        add("texel_cut", "texels before the first are taken for the first", spoiled_at(site::base, texel_cut));
        add("nearest_by_corners", "the texel whose corner is nearest is taken, not the one around the place",
            mistake_at(site::nearest_place, Change::half_more));
        add("texel_rounded", "the nearest texel is taken for the one before", spoiled_at(site::base, rounded));
        add("not_interpolated", "of the texels around a place the nearest is taken",
            mistake_at(site::interpolates, Change::never));
        add("y_mixed_as_x", "texels are mixed along y as along x", spoiled_at(site::fractions, y_is_x));
        add("fractions_turned", "texels are mixed along x as along z, and along z as along x",
            mistake_at(site::fractions, Change::xz_swapped));
        add("b_spline", "the four weights are those of a B-spline, which goes through no texel",
            formula_at(site::weights, b_spline));
        add("supersample_of_one_place", "all samples lie at the point", mistake_at(site::sample_offset, Change::zero));
        add("supersample_too_wide", "samples lie in two voxels along each axis, not in one",
            mistake_at(site::sample_offset, Change::doubled));
        add("supersample_of_side", "the sum of the samples is divided by their number along an axis",
            spoiled_at(site::sample_mean, of_side));
        add("voxel_size_for_inverse", "places are multiplied by a voxel's size, not divided by it",
            mistake_at(site::inv_voxel, Change::reciprocal));
        add("place_y_and_z_swapped", "a place's y is taken for its z", formula_at(site::grid_place, yz_swapped));
        add("place_x_and_z_swapped", "a place's x is taken for its z", formula_at(site::grid_place, xz_swapped));
        add("lit_from_behind",
            "surfaces are lit from behind: directions are from the lights to the point, or normals point inwards",
            mistake_at(site::sampled_direction, Change::negated));
        add("lit_from_both_sides", "light from behind lights as light from the front does",
            spoiled_at(site::lambert, of_both_sides));
        add("lambert_stepped", "what faces the lights is fully lit", spoiled_at(site::lambert, stepped));
        add("lambert_squared", "the cosine is squared", mistake_at(site::lambert, Change::times, -1, &site::cosine));
        add("cosine_without_z", "the cosine leaves z out", spoiled_at(site::cosine, cosine_without_z));
        add("colour_turned", "red and blue of what is sampled are swapped",
            mistake_at(site::sampled_colour, Change::xz_swapped));
        add("place_cut", "places are cut to whole voxels", spoiled_at(site::grid_place, whole));
        add("samples_on_a_diagonal", "samples lie on a diagonal of the voxel",
            formula_at(site::sample_place, on_diagonal));
        add("fractions_smoothed", "texels are mixed by a curve, not by a line", formula_at(site::fractions, smoothed));
        add("half_lambert", "the cosine is moved from -1..1 to 0..1", spoiled_at(site::lambert, moved_to_0_1));
        add("lambert_missing", "surfaces are lit whatever way they face", mistake_at(site::lambert, Change::one));
        add("ambient_without_albedo", "ambient light is the same on every surface",
            formula_at(site::radiance, ambient_without_albedo));
        add("light_without_albedo", "what the lights add is the same on every surface",
            formula_at(site::radiance, light_without_albedo));
        add("ambient_at_least", "ambient light is not added, but the least there is",
            formula_at(site::radiance, at_least_ambient));
        add("albedo_decoded", "the albedo is taken for codes of a curve, and decoded",
            formula_at(site::albedo, by_power));
        add("normal_y_and_z_swapped", "a normal's y is taken for its z",
            mistake_at(site::surface_normal, Change::yz_swapped));
        add("textures_swapped", "colours and directions are read of each other's texture",
            with(mistake_at(site::own_colour, Change::never), own_direction));
        add("direction_of_colour", "the texture of colours is read for directions", own_direction);
        all.push_back({.name = "surfaces_black",
                       .meaning = "what is lit is black",
                       .pass = pass,
                       .mistake = mistake_at(site::radiance, Change::zero),
                       .describes = true});
        all.push_back({.name = "light_missing",
                       .meaning = "what the textures hold lights nothing",
                       .pass = pass,
                       .mistake = mistake_at(site::diffuse, Change::zero),
                       .describes = true});
        add("colour_by_count", "the colour is divided by the number of lights",
            formula_at(site::sampled_colour, divided<site::sampled_count>));
        add("colour_by_weights", "the colour is divided by the sum of weights",
            formula_at(site::sampled_colour, divided<site::sampled_weight>));
        add("direction_by_weights", "the direction is divided by the sum of weights, not by its length",
            formula_at(site::to_lights, by_weights));
        add("directionality_turned", "the shares of directed and of even light are swapped",
            formula_at(site::directionality, turned_share));
        add("directionality_above_one", "the share of directed light is not held at 1",
            mistake_at(site::is_one, Change::never));
        add("even_light_missing", "light without a direction is lost", mistake_at(site::even_share, Change::zero));
        add("even_light_doubled", "of even light a half is seen, not a quarter",
            mistake_at(site::even_share, Change::doubled));
        add("alpha_is_zero", "alpha is 0, not 1", mistake_at(site::lit, Change::zero, 3));
    }
    all.push_back({"normal_from_0_to_1", "normals are taken to be stored from 0 to 1", "deferred_light_pass",
                   spoiled_at(site::surface_normal, from_0_to_1)});
    all.push_back({"background_missing", "what is nowhere is black", "forward_light_pass",
                   mistake_at(site::background, Change::zero)});
    all.push_back({"read_upside_down", "the first row is lit as the last one", "deferred_light_pass",
                   mistake_at(site::same_row, Change::never)});
    return all;
}

} // namespace lockstep::lights
