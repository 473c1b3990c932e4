#include "crosscheck/fluid/mistake_lists.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/fluid/shading.hpp"
#include "reference/fluid/sites.hpp"
#include "reference/system/encode_twin.hpp"

namespace lockstep::fluid {
namespace {

void light_of_world(Words value, const CameBy& /*run*/) {
    value[0] = value[2] = 0.0F;
    value[1] = 1.0F;
}
void absorbed_by_colour(Words value, const CameBy& run) {
    for (std::size_t c = 0; c < 3; ++c)
        value[c] = run.of(site::colour)[c] * first(run, site::dark);
}
void bent_whole(Words value, const CameBy& /*run*/) { value[0] = most_bend; }
void mirrored_y(Words value, const CameBy& run) { value[0] = run.of(site::mirrored)[1]; }
void mirror_for_refraction(Words value, const CameBy& run) {
    const float share = first(run, site::fresnel);
    for (std::size_t c = 0; c < 3; ++c)
        value[c] = run.of(site::sky)[c] * (1.0F - share) + run.of(site::refracted)[c] * share;
}
void red_is_green(Words value, const CameBy& /*run*/) { value[0] = value[1]; }
void without_specular(Words value, const CameBy& run) {
    for (std::size_t c = 0; c < 3; ++c)
        value[c] = run.of(site::diffuse)[c] + run.of(site::surface)[c] * first(run, site::alpha);
}
void surface_whole(Words value, const CameBy& run) {
    for (std::size_t c = 0; c < 3; ++c)
        value[c] = run.of(site::diffuse)[c] + (run.of(site::surface)[c] + first(run, site::specular));
}

/// The opposite, which a shader makes by swapping what it mixes.
void mixed_the_other_way(Words value, const CameBy& /*run*/) { value[0] = 1.0F - value[0]; }

// The place of the scene, by another offset.

float aside(const CameBy& run, const Site& centre, float offset, const Site& size) {
    return first(run, centre) + offset * first(run, size);
}
float leaning(const CameBy& run, std::size_t axis) { return first(run, site::bend_of) * run.of(site::normal_in)[axis]; }

void x_as_far_as_y(Words value, const CameBy& run) {
    value[0] = aside(run, site::pixel_x, leaning(run, 0), site::width);
}
void x_turned(Words value, const CameBy& run) {
    value[0] =
        aside(run, site::pixel_x, -(first(run, site::bend_of) * 0.75F * run.of(site::normal_in)[0]), site::width);
}
void y_turned(Words value, const CameBy& run) { value[0] = aside(run, site::pixel_y, -leaning(run, 1), site::height); }
void y_as_x_leans(Words value, const CameBy& run) {
    value[0] = aside(run, site::pixel_y, leaning(run, 0), site::height);
}
void y_narrowed(Words value, const CameBy& run) {
    value[0] = aside(run, site::pixel_y, first(run, site::bend_of) * 0.75F * run.of(site::normal_in)[1], site::height);
}
void x_in_pixels(Words value, const CameBy& run) {
    value[0] = first(run, site::pixel_x) + first(run, site::bend_of) * 0.75F * run.of(site::normal_in)[0];
}
void y_in_pixels(Words value, const CameBy& run) { value[0] = first(run, site::pixel_y) + leaning(run, 1); }

template <std::size_t axis> void bent_by(Words value, const CameBy& run) {
    const float t = std::clamp((run.of(site::world)[axis] - 0.1F) / (0.4F - 0.1F), 0.0F, 1.0F);
    value[0] = most_bend * (t * t * (3.0F - 2.0F * t));
}

// What is absorbed.

void of_thickness_alone(Words value, const CameBy& run) { std::fill_n(value.begin(), 3, first(run, site::dark)); }
void less_what_is_absorbed(Words value, const CameBy& run) {
    for (std::size_t c = 0; c < 3; ++c)
        value[c] = 1.0F - run.of(site::absorbed)[c];
}
void less_its_square(Words value, const CameBy& /*run*/) { value[0] = -(value[0] * value[0]); }
void to_base_2(Words value, const CameBy& /*run*/) { value[0] *= std::numbers::ln2_v<float>; }
void floor_for_ceiling(Words value, const CameBy& run) {
    if (const float floor = first(run, site::floor_of_thickness); floor > 0.0F)
        value[0] = std::min(first(run, site::thickness_in), floor);
}

// Light.

void decoded_again(Words normal, const CameBy& /*run*/) {
    for (float& x : normal)
        x = x * 2.0F - 1.0F;
}
void left_encoded(Words normal, const CameBy& /*run*/) {
    for (float& x : normal)
        x = x * 0.5F + 0.5F;
}
void above_0(Words value, const CameBy& /*run*/) { value[0] = std::max(value[0], 0.0F); }
void beside_the_spot(Words value, const CameBy& /*run*/) { value[0] = 0.05F; }
void half_the_light(Words value, const CameBy& run) {
    value[0] = first(run, site::lambert) * first(run, site::spot) * 0.5F;
}
void untinted(Words value, const CameBy& run) {
    for (std::size_t c = 0; c < 3; ++c)
        value[c] = run.of(site::colour)[c] * first(run, site::scattered);
}
void surface_the_other_way(Words value, const CameBy& run) {
    for (std::size_t c = 0; c < 3; ++c)
        value[c] = run.of(site::diffuse)[c] +
                   (run.of(site::surface)[c] + first(run, site::specular)) * (1.0F - first(run, site::alpha));
}
void specular_whole(Words value, const CameBy& run) {
    for (std::size_t c = 0; c < 3; ++c)
        value[c] = run.of(site::diffuse)[c] +
                   (run.of(site::surface)[c] * first(run, site::alpha) + first(run, site::specular));
}
void shine_raised_to_given(Words value, const CameBy& run) {
    value[0] = std::pow(first(run, site::shine), run.constants[0]);
}

// Fresnel's term.

void of_light(Words value, const CameBy& run) { value[0] = 1.0F - std::max(first(run, site::lambert), 0.0F); }
void of_halfway(Words value, const CameBy& run) { value[0] = 1.0F - first(run, site::shine); }
void grazing_raised_to_given(Words value, const CameBy& run) {
    value[0] = std::pow(first(run, site::grazing), run.constants[0]);
}
void power_of_cosine_taken_off(Words value, const CameBy& run) {
    value[0] = 1.0F - std::pow(first(run, site::cosine), run.constants[0]);
}
void refraction_whole(Words value, const CameBy& run) {
    for (std::size_t c = 0; c < 3; ++c)
        value[c] = run.of(site::refracted)[c] + run.of(site::sky)[c] * first(run, site::fresnel);
}
void times_r0(Words value, const CameBy& run) {
    const float r0 = first(run, site::r0);
    value[0] = r0 * ((1.0F - r0) * first(run, site::raised));
}
void above_one(Words value, const CameBy& run) { value[0] = first(run, site::r0) + first(run, site::raised); }

// sRGB's curve.

float taken_back(float x) {
    const double v = std::clamp(double{x}, 0.0, 1.0);
    return static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
}
void curve_once_less(Words value, const CameBy& /*run*/) {
    for (float& x : value)
        x = taken_back(x);
}
void curve_once_more(Words value, const CameBy& /*run*/) {
    for (float& x : value)
        x = static_cast<float>(srgb_curve(std::clamp(double{x}, 0.0, 1.0)));
}
void curve_turned(Words value, const CameBy& /*run*/) {
    for (float& x : value)
        x = taken_back(taken_back(x));
}
void power_for_curve(Words value, const CameBy& /*run*/) {
    for (float& x : value)
        x = taken_back(static_cast<float>(std::pow(std::clamp(double{x}, 0.0, 1.0), 1.0 / 2.2)));
}

void of_refraction(Of& of) {
    static const Mistake rows_in_pixels = formula_at(site::fetch_y, y_in_pixels),
                         rows_narrowed = formula_at(site::fetch_y, y_narrowed);
    of.add("refraction_as_wide_as_high", "the scene behind is moved as far along x as along y",
           spoiled_at(site::fetch_x, x_as_far_as_y))
        .add("refraction_x_turned", "the scene behind is moved the other way along x",
             spoiled_at(site::fetch_x, x_turned))
        .add("refraction_y_turned", "the scene behind is moved the other way along y",
             spoiled_at(site::fetch_y, y_turned))
        .add("refraction_y_of_x", "the scene behind is moved along y as the normal leans along x",
             spoiled_at(site::fetch_y, y_as_x_leans))
        .add("refraction_aspect_turned", "the scene behind is moved less along y than along x",
             with(formula_at(site::fetch_x, x_as_far_as_y), rows_narrowed))
        .add("texels_from_corners", "texels of the scene are taken at their corners",
             mistake_at(site::texels_have_middles, Change::never))
        .add("scene_shares_turned", "texels of the scene have each other's shares",
             formula_at(site::fraction, mixed_the_other_way))
        .add("scene_not_filtered", "the scene is the nearest texel's", mistake_at(site::fraction, Change::zero))
        .add("refraction_in_pixels", "the scene behind is moved by pixels, not by shares of the image",
             with(formula_at(site::fetch_x, x_in_pixels), rows_in_pixels))
        .add("bent_by_x", "light is bent by how far along x it comes from", formula_at(site::bend_of, bent_by<0>))
        .add("bend_turned", "light from low water is bent, not from high", mistake_at(site::bend_rises, Change::never))
        .add("bent_by_z", "light is bent by how far along z it comes from", formula_at(site::bend_of, bent_by<2>))
        .add("scene_rows_by_half_a_texel", "the scene is fetched half a texel below",
             mistake_at(site::pixel_y, Change::half_less))
        .add("absorbed_without_colour", "fluid of any colour takes all colours alike",
             spoiled_at(site::absorbed, of_thickness_alone))
        .add("absorbed_as_red", "all colours are absorbed as red is", mistake_at(site::absorbed, Change::x_everywhere))
        .add("absorption_linear", "absorption is linear", spoiled_at(site::transmission, less_what_is_absorbed))
        .add("absorption_squared", "what is absorbed is squared", spoiled_at(site::exponent, less_its_square))
        .add("base_of_2", "powers of 2 are taken for those of e", formula_at(site::exponent, to_base_2))
        .add("thickness_is_one", "fluid is a metre thick", mistake_at(site::dark, Change::one))
        .add("floor_is_ceiling", "the least thickness is the greatest", spoiled_at(site::dark, floor_for_ceiling))
        .add("colour_turned", "red and blue of the fluid are swapped", mistake_at(site::colour, Change::xz_swapped));
}

void of_lights(Of& of, const Host& host) {
    const auto constants = [](const glm::vec4& v) { return Constants{v.x, v.y, v.z}; };
    of.add("light_from_below", "the light comes from below", mistake_at(site::light, Change::negated))
        .add("light_along_x", "the light comes along x", given(site::light, constants(host.view()[0])))
        .add("light_along_z", "the light comes along z", given(site::light, constants(host.view()[2])))
        .add("light_turned_back", "the light is turned from view space to the world",
             given(site::light, constants(host.inverse_view()[1])))
        .add_free("normal_of_world", "normals are turned to the world, and the rest is not",
                  mistake_at(site::normal_is_of_view, Change::inverted))
        .add("normal_decoded", "normals are taken to be stored from 0 to 1", spoiled_at(site::normal_in, decoded_again))
        .add("normal_left_encoded", "normals are read from 0 to 1", spoiled_at(site::normal_in, left_encoded))
        .add("lambert_cut", "light from behind is cut before it is wrapped", spoiled_at(site::lambert, above_0))
        .add("steps_linear", "steps are linear, not smooth", mistake_at(site::step_is_smooth, Change::never))
        .add("spot_turned", "light is that beside the spot", spoiled_at(site::spot, beside_the_spot))
        .add("wrap_not_moved", "light is halved, and not wrapped", spoiled_at(site::wrapped, half_the_light))
        .add("to_eye_not_unit", "the direction to the eye is not normalised",
             mistake_at(site::to_eye, Change::not_done))
        .add("tint_turned", "light and shade are swapped", formula_at(site::wrapped, mixed_the_other_way))
        .add("tint_left_out", "light and shade have one colour", formula_at(site::diffuse, untinted))
        .add("diffuse_whole", "diffuse light is not weighted", mistake_at(site::scattered, Change::one))
        .add("surface_by_1_minus_alpha", "the surface is weighted by 1 - alpha",
             spoiled_at(site::surface_light, surface_the_other_way))
        .add("specular_whole", "the highlight is not weighted by alpha",
             formula_at(site::surface_light, specular_whole))
        .add("specular_power", "the highlight is raised to another power",
             formula_at(site::specular, shine_raised_to_given),
             {{5.0F}, {10.0F}, {16.0F}, {20.0F}, {32.0F}, {50.0F}, {64.0F}, {100.0F}, {128.0F}, {200.0F}, {250.0F}});
}

void of_mirrors(Of& of, const Host& host) {
    const glm::mat4& to_world = host.inverse_view();
    of.add("fresnel_of_light", "the Fresnel term is that of the light's direction", spoiled_at(site::grazing, of_light))
        .add("fresnel_of_halfway", "the Fresnel term is that of the halfway vector",
             spoiled_at(site::grazing, of_halfway))
        .add("fresnel_power", "the Fresnel term is raised to another power",
             formula_at(site::raised, grazing_raised_to_given), {{2.0F}, {3.0F}, {4.0F}, {5.0F}, {6.0F}, {8.0F}})
        .add("fresnel_raised_first", "the Fresnel term has the cosine raised, not 1 less it",
             formula_at(site::raised, power_of_cosine_taken_off,
                        {static_cast<float>(host.settings().shading.fresnel_power)}))
        .add("fresnel_without_sum", "the Fresnel term is a product with R0", spoiled_at(site::fresnel, times_r0))
        .add("fresnel_is_cosine", "the cosine is taken for the Fresnel term", instead_of(site::fresnel, site::cosine))
        .add("refraction_whole", "what comes through is not weighted by the Fresnel term",
             spoiled_at(site::surface, refraction_whole))
        .add("mirror_left_out", "nothing is mirrored", instead_of(site::surface, site::refracted))
        .add("mirror_alone", "nothing comes through", instead_of(site::surface, site::sky))
        .add("fresnel_above_one", "the Fresnel term leaves out 1 - R0", spoiled_at(site::fresnel, above_one))
        .add("sky_of_normal", "the sky is that which the normal points at", instead_of(site::mirrored, site::normal_in))
        .add("sky_behind", "the sky is that behind the surface", instead_of(site::mirrored, site::incident))
        .add("mirror_by_column", "a column of the matrix is taken for its row",
             given(site::up_row, {to_world[1][0], to_world[1][1], to_world[1][2]}))
        .add("sky_along_z", "the sky is that along z",
             given(site::up_row, {to_world[0][2], to_world[1][2], to_world[2][2]}));
}

} // namespace

void add_shading_mistakes(Of of, const Host& host) {
    of.add("to_eye_turned", "the direction from the eye is taken for that to it",
           mistake_at(site::to_eye, Change::negated))
        .add("light_not_turned", "the light's direction stays in world space", spoiled_at(site::light, light_of_world))
        .add("world_is_view", "the point in view space is taken for that in the world",
             instead_of(site::world, site::point))
        .add("halfway_by_difference", "the halfway vector is a difference of directions, not their sum",
             mistake_at(site::halfway_by_sum, Change::never))
        .add("halfway_not_unit", "the halfway vector is not normalised", mistake_at(site::halfway, Change::not_done))
        .add("shine_of_normal_and_eye", "the highlight is that of the eye's direction",
             instead_of(site::shine, site::cosine))
        .add("specular_not_raised", "the highlight is not raised to a power", instead_of(site::specular, site::shine))
        .add_description("specular_left_out", "there is no highlight",
                         spoiled_at(site::surface_light, without_specular))
        .add("refraction_left_out", "the scene behind is not moved", mistake_at(site::offset, Change::zero))
        .add("refraction_turned", "the scene behind is moved the other way", mistake_at(site::offset, Change::negated))
        .add("refraction_not_bent_by_height", "the scene behind is moved at any height",
             spoiled_at(site::bend_of, bent_whole))
        .add("scene_by_half_a_texel", "the scene is fetched half a texel aside",
             mistake_at(site::pixel_x, Change::half_less))
        .add("transmission_left_out", "fluid does not darken what is behind",
             mistake_at(site::transmission, Change::one))
        .add("absorbed_by_colour", "fluid takes its own colour from what is behind",
             spoiled_at(site::absorbed, absorbed_by_colour))
        .add("darkens_without_minus", "fluid brightens what is behind", mistake_at(site::exponent, Change::negated))
        .add("thickness_ignored", "fluid of any thickness is clear", mistake_at(site::dark, Change::zero))
        .add("thickness_floor_missing", "thin fluid is as thin as it is",
             mistake_at(site::floor_of_thickness, Change::zero))
        .add("spot_left_out", "light is the same everywhere", mistake_at(site::spot, Change::one))
        .add("not_wrapped", "light is not wrapped around", instead_of(site::wrapped, site::lambert))
        .add("shade_turned", "red and blue of what has no light are swapped",
             mistake_at(site::tint, Change::xz_swapped))
        .add("quarter_around", "from all around comes half as much light", mistake_at(site::half_light, Change::halved))
        .add("diffuse_left_out", "there is no diffuse light", mistake_at(site::diffuse, Change::zero))
        .add("fresnel_turned", "mirror and refraction are swapped", spoiled_at(site::surface, mirror_for_refraction))
        .add("fresnel_opposite", "what is mirrored is let through, and the other way around",
             mistake_at(site::fresnel, Change::opposite))
        .add("fresnel_not_raised", "the Fresnel term is linear", instead_of(site::raised, site::grazing))
        .add("fresnel_without_r0", "surfaces seen from above mirror nothing", mistake_at(site::r0, Change::zero))
        .add("fresnel_of_cosine", "the Fresnel term rises where it should fall",
             instead_of(site::grazing, site::cosine))
        .add("mirror_of_eye", "the direction to the eye is mirrored", mistake_at(site::mirrors_to_eye, Change::always))
        .add("mirror_from_eye", "the direction from the eye is mirrored",
             mistake_at(site::mirrors_to_eye, Change::never))
        .add("mirror_not_turned", "the mirrored direction stays in view space", spoiled_at(site::mirror_y, mirrored_y))
        .add("mirror_single", "N.I is taken once", mistake_at(site::along_normal, Change::halved))
        .add("sky_turned", "the sky is below", mistake_at(site::sky_share, Change::opposite))
        .add("sky_bias_missing", "the sky has no bias", mistake_at(site::sky_bias, Change::zero))
        .add("sky_left_out", "no sky is mirrored", mistake_at(site::sky, Change::zero))
        .add("alpha_turned", "alpha and 1 - alpha are swapped", mistake_at(site::alpha, Change::opposite))
        .add("scattered_by_alpha", "scattered light is weighted by alpha, not by 1 - alpha",
             instead_of(site::scattered, site::alpha))
        .add("alpha_of_surface_missing", "the surface is not weighted by alpha",
             spoiled_at(site::surface_light, surface_whole))
        .add("scene_left_out", "where there is no fluid the scene is black", mistake_at(site::background, Change::zero))
        .add("normal_turned", "normals point inwards", mistake_at(site::normal_in, Change::negated))
        .add("lit_red_is_green", "green is stored as red", spoiled_at(site::lit, red_is_green))
        .add("lit_turned", "red and blue are swapped", mistake_at(site::light_to_eye, Change::xz_swapped));
    add_point_mistakes(of, host);
    of.add("depth_as_ndc", "what is stored is taken for NDC depth", mistake_at(site::reads_ndc, Change::always));
    of_refraction(of);
    of_lights(of, host);
    of_mirrors(of, host);
}

void add_encoding_mistakes(Of of) {
    of.add("encoded_turned", "red and blue are swapped", mistake_at(site::radiance_in, Change::xz_swapped))
        .add("code_cut", "codes are cut, not rounded", mistake_at(site::code_value, Change::half_less))
        .add("curve_left_out", "sRGB's curve is left out", spoiled_at(site::radiance_in, curve_once_less))
        .add("curve_once_more", "sRGB's curve is applied once more", spoiled_at(site::radiance_in, curve_once_more))
        .add("curve_turned", "sRGB's curve is taken back, not applied", spoiled_at(site::radiance_in, curve_turned))
        .add("power_for_curve", "a power of 1 / 2.2 is taken for sRGB's curve",
             spoiled_at(site::radiance_in, power_for_curve));
}

} // namespace lockstep::fluid
