#include "crosscheck/fluid/mistake_lists.hpp"

#include <cmath>

#include "reference/fluid/sites.hpp"

namespace lockstep::fluid {
namespace {

void last_addend(Words value, const CameBy& run) { value[0] = first(run, site::addend); }
void distance_on_disc(Words value, const CameBy& run) { value[0] = std::sqrt(first(run, site::magnitude)); }
void distance_of_square(Words value, const CameBy& /*run*/) { value[0] = std::sqrt(value[0]); }
/// A place on the window without the half that moves it from its middle to its edge.
void from_middle_of_width(Words value, const CameBy& run) {
    value[0] = first(run, site::place_x) * 0.5F * first(run, site::width);
}
void from_middle_of_height(Words value, const CameBy& run) {
    value[0] = first(run, site::place_y) * 0.5F * first(run, site::height);
}

void by_square(Words value, const CameBy& run) { value[0] /= first(run, site::w); }
void bulge_of_half(Words value, const CameBy& run) { value[0] = first(run, site::half) * first(run, site::nz); }
void off_half_the_disc(Words answer, const CameBy& /*run*/) { answer[0] = answer[2] > 0.25F ? 1.0F : 0.0F; }
void gaussian(Words value, const CameBy& run) {
    value[0] = first(run, site::gain) * std::exp(-first(run, site::magnitude));
}
void half_of_ndc(Words value, const CameBy& run) { value[0] = first(run, site::ndc) * 0.5F; }

/// What makes a sprite's size of its radius, by the host's other numbers.
void of_point_scale(Of& of, const Host& host) {
    const double width = host.settings().width, height = host.settings().height, p11 = host.projection()[1][1];
    if (host.switches().point_scale == PointScale::width_60) {
        of.add("scale_by_height", "a sprite's size goes with the image's height",
               scaled(site::point_scale, height / width));
        return;
    }
    of.add("scale_by_width", "a sprite's size goes with the image's width", scaled(site::point_scale, width / height))
        .add("scale_without_angle", "a sprite's size leaves out the camera's angle",
             scaled(site::point_scale, 1.0 / p11))
        .add("scale_by_tangent", "a sprite's size is multiplied by the tangent, not divided",
             scaled(site::point_scale, 1.0 / (p11 * p11)));
}

void of_sprites(Of& of, const Host& host) {
    static const Mistake y_not_divided = mistake_at(site::place_y, Change::not_done),
                         y_from_middle = formula_at(site::window_y, from_middle_of_height);
    const auto p11 = host.projection()[1][1];
    const double near = host.settings().camera.near_plane, far = host.settings().camera.far_plane;
    of.add("size_is_half", "a sprite's size is taken for half of it", mistake_at(site::half, Change::doubled))
        .add("half_of_half", "half a sprite is halved again", mistake_at(site::half, Change::halved))
        .add("nz_not_rooted", "the height of the sphere is not a root", mistake_at(site::nz, Change::not_done))
        .add("nz_of_rim", "the height of the sphere is the distance on the disc",
             formula_at(site::nz, distance_on_disc))
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
    of.add("view_transposed", "the view matrix is transposed", mistake_at(site::view, Change::transposed))
        .add("view_not_moved", "positions are turned into view space, but not moved",
             mistake_at(site::view_moves, Change::never))
        .add("sprite_rows_in_corners", "rows of sprites are measured from pixels' corners",
             mistake_at(site::pixel_y, Change::half_less))
        .add("window_mirrored", "x runs to the left", mistake_at(site::place_x, Change::negated))
        .add("width_is_height", "the image is taken to be as wide as high",
             given(site::width, {static_cast<float>(host.settings().height)}))
        .add("x_by_p11", "x is scaled as y is", given(site::p00, {p11}))
        .add("places_not_divided", "places are not divided by the distance",
             with(mistake_at(site::place_x, Change::not_done), y_not_divided))
        .add("window_from_middle", "pixels are counted from the image's middle",
             with(formula_at(site::window_x, from_middle_of_width), y_from_middle))
        .add("disc_of_half", "sprites are cut to discs of half their size",
             decided_at(site::off_disc, off_half_the_disc))
        .add("size_by_square", "a sprite's size is divided by the square of the distance",
             formula_at(site::size, by_square))
        .add("height_of_distance", "the height of the sphere is by the distance, not by its square",
             spoiled_at(site::magnitude, distance_of_square))
        .add("ndc_turned", "NDC depth is negated, as where near and far are swapped",
             mistake_at(site::depth_coefficients, Change::negated))
        .add("depth_from_0", "clip depth is that of a range from 0 to 1",
             formula_at(site::depth_coefficients, as_given,
                        {static_cast<float>(far / (near - far)), static_cast<float>(near * far / (near - far))}));
    if (host.switches().point_size == PointSize::clip_w)
        of.add("size_by_distance", "a sprite's size is divided by the distance to the eye",
               mistake_at(site::sized_by_w, Change::never));
    else
        of.add("size_by_w", "a sprite's size is divided by the distance along the view",
               mistake_at(site::sized_by_w, Change::always));
    of_point_scale(of, host);
}

} // namespace

void add_depth_mistakes(Of of, const Host& host) {
    of.add("codes_left_out", "the depth has no codes", mistake_at(site::has_codes, Change::never));
    if (host.switches().depth_value == DepthValue::window)
        of.add("window_not_moved", "window depth is half of NDC depth", spoiled_at(site::window, half_of_ndc));
}

void add_sphere_mistakes(Of of, const Host& host) {
    of_sprites(of, host);
    if (host.switches().sphere == Sphere::ray)
        add_ray_mistakes(of, host);
    add_depth_mistakes(of, host);
    of.add_description("no_sphere", "no sphere is drawn", mistake_at(site::sphere_here, Change::never));
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
    of.add("discs_in_front", "spheres are flat discs in front of them", mistake_at(site::nz, Change::one))
        .add("bulge_doubled", "the surface is a diameter before the middle", mistake_at(site::rise, Change::doubled))
        .add("scene_tested_at_middle", "a sphere's middle is held against the scene",
             mistake_at(site::scene_tests_surface, Change::never))
        .add("scene_test_turned", "what lies before the scene is hidden",
             mistake_at(site::sphere_here, Change::reversed, 2))
        .add("nearest_middle", "the sphere with the nearest middle is seen",
             mistake_at(site::nearest_is_of_surface, Change::never))
        .add("bulge_in_pixels", "the surface is before the middle by pixels", spoiled_at(site::rise, bulge_of_half))
        .add("chord_not_scaled", "half a chord is not divided by the ray's length",
             mistake_at(site::chord_by_ray, Change::not_done));
}

void add_thickness_mistakes(Of of, const Host& host) {
    of_sprites(of, host);
    of.add("even_discs", "spheres are as thick at their edge", mistake_at(site::nz, Change::one))
        .add("half_the_chord", "only half of a sphere is counted", mistake_at(site::gain, Change::halved))
        .add("thickness_not_scaled", "thickness is not scaled", mistake_at(site::gain, Change::one))
        .add("not_blended", "the last sphere alone is stored", spoiled_at(site::thickness, last_addend))
        .add("thickness_rounded_down", "units are rounded down", mistake_at(site::half_unit, Change::zero))
        .add("last_sphere_left_out", "the last sphere is left out", mistake_at(site::takes_last_sphere, Change::never));
    const bool is_fixed = host.switches().thickness_sum == ThicknessSum::fixed;
    of.add_description("no_thickness", "no sphere has a thickness",
                       mistake_at(is_fixed ? site::quantum : site::thickness, Change::zero));
    of.add("thickness_doubled", "spheres are twice as thick", mistake_at(site::addend, Change::doubled));
    of.add("thickness_gaussian", "spheres are as thick as a Gaussian", formula_at(site::addend, gaussian))
        .add("first_sphere_alone", "the first sphere alone is counted", mistake_at(site::adds_all, Change::never))
        .add("scene_test_turned", "what lies before the scene is hidden",
             mistake_at(site::nearer_than_scene, Change::reversed, 0));
}

} // namespace lockstep::fluid
