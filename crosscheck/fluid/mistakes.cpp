#include "crosscheck/fluid/mistakes.hpp"

#include <cstddef>
#include <span>

#include "reference/fluid/shading.hpp"
#include "reference/fluid/sites.hpp"

namespace lockstep::fluid {
namespace {

using Words = std::span<float>;

Mistake spoiled_at(const Site& site, Formula formula) {
    return {.site = site.id, .change = Change::spoiled, .formula = formula};
}
Mistake instead_of(const Site& site, const Site& source) { return mistake_at(site, Change::instead, -1, &source); }

float first(const CameBy& run, const Site& site) { return run.of(site)[0]; }

void last_addend(Words value, const CameBy& run) { value[0] = first(run, site::addend); }
void light_of_world(Words value, const CameBy& /*run*/) {
    value[0] = value[2] = 0.0F;
    value[1] = 1.0F;
}
void absorbed_by_colour(Words value, const CameBy& run) {
    for (std::size_t c = 0; c < 3; ++c)
        value[c] = run.of(site::colour)[c] * first(run, site::dark);
}
void shorter_at_both_ends(Words loop, const CameBy& /*run*/) {
    loop[0] += 1.0F;
    loop[1] -= 1.0F;
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

/// Mistakes of one pass.
class Of {
  public:
    Of(std::vector<NamedMistake>& all, const char* pass) : all_(all), pass_(pass) {}
    Of& add(const char* name, const char* meaning, const Mistake& mistake) {
        all_.push_back({name, meaning, pass_, mistake});
        return *this;
    }

  private:
    std::vector<NamedMistake>& all_;
    const char* pass_;
};

void of_sprites(Of of) {
    of.add("size_is_half", "a sprite's size is taken for half of it", mistake_at(site::half, Change::doubled))
        .add("half_of_half", "half a sprite is halved again", mistake_at(site::half, Change::halved))
        .add("nz_not_rooted", "the height of the sphere is not a root", mistake_at(site::nz, Change::not_done))
        .add("sprite_in_corners", "sprites are measured from pixels' corners",
             mistake_at(site::pixel_x, Change::half_less))
        .add("near_plane_ignored", "spheres before the near plane are drawn", mistake_at(site::near, Change::zero))
        .add("square_sprites", "sprites are not cut to discs", mistake_at(site::off_disc, Change::never))
        .add("radius_left_out", "a sprite's size is the scale alone", instead_of(site::sprite_scale, site::point_scale))
        .add("size_not_divided", "sprites are as large far away as near by", mistake_at(site::size, Change::not_done))
        .add("window_upside_down", "y runs downwards", mistake_at(site::place_y, Change::negated))
        .add("height_is_width", "the image is taken to be as high as wide", instead_of(site::height, site::width))
        .add("behind_scene_kept", "what lies behind the scene is drawn", mistake_at(site::tests_scene, Change::never))
        .add("scene_tested_by_ndc", "NDC depth is held against the scene's window depth",
             instead_of(site::window, site::ndc))
        .add("coefficients_swapped", "the two numbers that make depths of z are swapped",
             mistake_at(site::depth_coefficients, Change::swapped));
}

void of_spheres(Of of) {
    of_sprites(of);
    of.add("back_of_sphere", "the far side of spheres is stored", mistake_at(site::nz, Change::negated))
        .add("spheres_are_discs", "spheres are flat discs", mistake_at(site::nz, Change::zero))
        .add("unit_spheres", "spheres are of a metre", instead_of(site::rise, site::nz))
        .add("farthest_sphere", "the farthest sphere is seen", mistake_at(site::nearest_sphere, Change::greatest_taken))
        .add("last_sphere", "the sphere drawn last is seen, whatever its depth",
             mistake_at(site::nearest_sphere, Change::last_taken))
        .add("first_sphere", "the sphere drawn first is seen, whatever its depth",
             mistake_at(site::nearest_sphere, Change::first_taken))
        .add("depth_sign", "the distance is stored, not z", mistake_at(site::depth, Change::negated))
        .add("window_stored", "window depth is stored", instead_of(site::sphere_depth, site::window))
        .add("ndc_stored", "NDC depth is stored", instead_of(site::sphere_depth, site::ndc))
        .add("codes_cut", "codes of the depth are rounded down", mistake_at(site::half_code, Change::zero))
        .add("far_root", "rays meet the far side of spheres", mistake_at(site::half_chord, Change::negated))
        .add("chord_not_rooted", "half a chord is squared", mistake_at(site::half_chord, Change::not_done))
        .add("middle_of_ray", "rays end in the middle of spheres", mistake_at(site::half_chord, Change::zero))
        .add("ray_not_normalised", "rays are taken to be of a metre", mistake_at(site::along, Change::not_done));
}

void of_filters(Of of) {
    of.add("axes_swapped", "the samples lie along the other axis", mistake_at(site::blur_direction, Change::swapped))
        .add("empty_not_skipped", "empty samples are averaged", mistake_at(site::skips_empty, Change::never))
        .add("empty_centre_filtered", "pixels without fluid are filtered",
             mistake_at(site::centre_empty, Change::never))
        .add("sum_not_divided", "the sum is not divided by the weights", mistake_at(site::mean, Change::not_done))
        .add("range_weight_left_out", "samples far behind or before weigh as much",
             mistake_at(site::range_weight, Change::one))
        .add("range_step_unscaled", "steps in depth are not scaled", mistake_at(site::range_scale, Change::one))
        .add("spatial_weight_left_out", "all samples weigh the same", mistake_at(site::weight, Change::one))
        .add("row_weight_left_out", "samples of all rows weigh the same", mistake_at(site::row_weight, Change::one))
        .add("exponent_positive", "weights grow with the distance", mistake_at(site::exponent, Change::negated))
        .add("one_sample_short", "the last sample is left out", mistake_at(site::samples, Change::last_skipped))
        .add("first_sample_left_out", "the first sample is left out", mistake_at(site::samples, Change::first_skipped))
        .add("ends_left_out", "the first and the last sample are left out",
             {.site = site::samples.id, .change = Change::ranged_by_formula, .formula = shorter_at_both_ends})
        .add("last_row_left_out", "the last row of samples is left out", mistake_at(site::rows, Change::last_skipped))
        .add("first_row_left_out", "the first row of samples is left out",
             mistake_at(site::rows, Change::first_skipped))
        .add("partner_kept", "a refused sample's partner is kept", mistake_at(site::partner_weight, Change::never))
        .add("refused_kept", "samples that are too near are kept", mistake_at(site::too_near, Change::never))
        .add("far_not_drawn_in", "samples that are too far are kept as they are",
             mistake_at(site::too_far, Change::never))
        .add("drawn_in_forwards", "samples that are too far are drawn before the pixel",
             mistake_at(site::mu, Change::negated))
        .add("drawn_in_by_delta", "samples that are too far are drawn in by the range, not by mu",
             instead_of(site::mu, site::delta))
        .add("high_not_widened", "near samples do not widen the range", mistake_at(site::widens_high, Change::never))
        .add("low_not_widened", "far samples do not widen the range", mistake_at(site::widens_low, Change::never))
        .add("reach_not_by_depth", "the filter is as wide far away as near by",
             mistake_at(site::reach, Change::not_done))
        .add("flow_backwards", "the surface grows where it should shrink", mistake_at(site::flow_step, Change::negated))
        .add("flow_without_mixed", "the mixed derivative is left out", mistake_at(site::zxy, Change::zero))
        .add("flow_without_root", "the curvature is not divided", mistake_at(site::curvature, Change::not_done))
        .add("flow_over_edges", "neighbours beyond an edge are taken", mistake_at(site::within_reach, Change::always))
        .add("black_filtered", "black pixels are filtered", mistake_at(site::is_black, Change::never))
        .add("depth_kept", "the depth is not filtered", instead_of(site::smooth_depth, site::centre_depth));
}

void of_normals(Of of) {
    of.add("cross_turned", "the factors of the cross product are swapped", mistake_at(site::cross, Change::negated))
        .add("right_for_left", "the other side is taken along x", mistake_at(site::right_side, Change::inverted))
        .add("right_always", "the right side is taken everywhere", mistake_at(site::right_side, Change::always))
        .add("left_always", "the left side is taken everywhere", mistake_at(site::right_side, Change::never))
        .add("up_for_down", "the other side is taken along y", mistake_at(site::upper_side, Change::inverted))
        .add("left_turned", "steps from the left are turned", mistake_at(site::step_left, Change::negated))
        .add("lower_turned", "steps from below are turned", mistake_at(site::step_up, Change::negated))
        .add("facing_away", "where no side is the normal points away", mistake_at(site::facing, Change::negated))
        .add("normal_not_unit", "normals are as long as the cross product", mistake_at(site::normal, Change::not_done))
        .add("edges_not_facing", "what is beyond an edge is taken for a neighbour",
             mistake_at(site::faces_at_edges, Change::never))
        .add("empty_has_normal", "pixels without fluid have a normal", mistake_at(site::centre_empty, Change::never))
        .add("normal_x_turned", "x of normals is negated", mistake_at(site::normal, Change::negated, 0))
        .add("normal_y_turned", "y of normals is negated", mistake_at(site::normal, Change::negated, 1))
        .add("normal_xy_swapped", "x and y of normals are swapped", mistake_at(site::normal, Change::swapped))
        .add("depth_as_ndc", "what is stored is taken for NDC depth", mistake_at(site::reads_ndc, Change::always));
}

void of_thickness(Of of) {
    of_sprites(of);
    of.add("even_discs", "spheres are as thick at their edge", mistake_at(site::nz, Change::one))
        .add("half_the_chord", "only half of a sphere is counted", mistake_at(site::gain, Change::halved))
        .add("thickness_not_scaled", "thickness is not scaled", mistake_at(site::gain, Change::one))
        .add("not_blended", "the last sphere alone is stored", spoiled_at(site::thickness, last_addend))
        .add("thickness_rounded_down", "units are rounded down", mistake_at(site::half_unit, Change::zero))
        .add("last_sphere_left_out", "the last sphere is left out", mistake_at(site::takes_last_sphere, Change::never));
}

void of_shading(Of of) {
    of.add("to_eye_turned", "the direction from the eye is taken for that to it",
           mistake_at(site::to_eye, Change::negated))
        .add("light_not_turned", "the light's direction stays in world space", spoiled_at(site::light, light_of_world))
        .add("world_is_view", "the point in view space is taken for that in the world",
             instead_of(site::world, site::point))
        .add("halfway_not_unit", "the halfway vector is not normalised", mistake_at(site::halfway, Change::not_done))
        .add("shine_of_normal_and_eye", "the highlight is that of the eye's direction",
             instead_of(site::shine, site::cosine))
        .add("specular_not_raised", "the highlight is not raised to a power", instead_of(site::specular, site::shine))
        .add("specular_left_out", "there is no highlight", spoiled_at(site::surface_light, without_specular))
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
        .add("diffuse_left_out", "there is no diffuse light", mistake_at(site::diffuse, Change::zero))
        .add("fresnel_turned", "mirror and refraction are swapped", spoiled_at(site::surface, mirror_for_refraction))
        .add("fresnel_not_raised", "the Fresnel term is linear", instead_of(site::raised, site::grazing))
        .add("fresnel_without_r0", "surfaces seen from above mirror nothing", mistake_at(site::r0, Change::zero))
        .add("fresnel_of_cosine", "the Fresnel term rises where it should fall",
             instead_of(site::grazing, site::cosine))
        .add("mirror_of_eye", "the direction to the eye is mirrored",
             mistake_at(site::mirrors_to_eye, Change::inverted))
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
}

} // namespace

const std::vector<NamedMistake>& mistakes() {
    static const std::vector<NamedMistake> all = [] {
        std::vector<NamedMistake> made;
        Of(made, "motion_pass")
            .add("motion_left_out", "particles stay where they were", {.change = Change::item_kept})
            .add("motion_yz_swapped", "y and z of the positions are swapped",
                 mistake_at(site::position, Change::yz_swapped));
        Of(made, "scene_pass")
            .add("check_left_out", "the scene has no check", mistake_at(site::check, Change::zero))
            .add("check_turned", "the check is turned", mistake_at(site::check, Change::half_less))
            .add("sky_black", "there is no sky", mistake_at(site::sky_colour, Change::zero));
        Of(made, "scene_pass_depth")
            .add("scene_depth_turned", "depth is stored from the far plane",
                 mistake_at(site::surface_depth, Change::opposite));
        of_spheres({made, "sphere_depth_pass"});
        of_filters({made, "depth_filter_pass"});
        of_normals({made, "normal_pass"});
        Of(made, "thickness_clear_pass")
            .add("clear_left_out", "the thickness of the frame before is kept",
                 mistake_at(site::is_cleared, Change::never));
        of_thickness({made, "thickness_pass"});
        of_shading({made, "fluid_shade_pass"});
        for (const char* const pass : {"encode_pass", "encode_by_gl_pass"})
            Of(made, pass)
                .add("encoded_turned", "red and blue are swapped", mistake_at(site::radiance_in, Change::xz_swapped))
                .add("code_cut", "codes are cut, not rounded", mistake_at(site::code_value, Change::half_less));
        return made;
    }();
    return all;
}

} // namespace lockstep::fluid
