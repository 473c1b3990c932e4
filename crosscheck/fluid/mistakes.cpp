#include "crosscheck/fluid/mistakes.hpp"

#include "crosscheck/fluid/mistake_lists.hpp"
#include "reference/fluid/sites.hpp"

namespace lockstep::fluid {
namespace {

void ndc_of_window(Words value, const CameBy& /*run*/) { value[0] = value[0] * 2.0F - 1.0F; }

} // namespace

std::vector<NamedMistake> mistakes(const Host& host) {
    std::vector<NamedMistake> all;
    Of(all, "motion_pass")
        .add("motion_left_out", "particles stay where they were", {.change = Change::item_kept})
        .add("motion_yz_swapped", "y and z of the positions are swapped",
             mistake_at(site::position, Change::yz_swapped))
        .add("motion_xz_swapped", "x and z of the positions are swapped",
             mistake_at(site::position, Change::xz_swapped))
        .add("motion_xy_swapped", "x and y of the positions are swapped", mistake_at(site::position, Change::swapped))
        .add("motion_x_turned", "x of the positions is negated", mistake_at(site::position, Change::negated, 0))
        .add("motion_y_turned", "y of the positions is negated", mistake_at(site::position, Change::negated, 1))
        .add("motion_z_turned", "z of the positions is negated", mistake_at(site::position, Change::negated, 2));
    Of(all, "scene_pass")
        .add("check_left_out", "the scene has no check", mistake_at(site::check, Change::zero))
        .add("check_inverted", "light and dark of the check are swapped", mistake_at(site::check, Change::opposite))
        .add("check_turned", "the check is turned", mistake_at(site::check, Change::half_less))
        .add("check_of_half", "the check is of half a metre", mistake_at(site::surface_point, Change::doubled))
        .add("check_of_two", "the check is of two metres", mistake_at(site::surface_point, Change::halved))
        .add("sky_black", "there is no sky", mistake_at(site::sky_colour, Change::zero));
    Of(all, "scene_pass_depth")
        .add("scene_depth_turned", "depth is stored from the far plane",
             mistake_at(site::surface_depth, Change::opposite))
        .add("scene_depth_as_ndc", "NDC depth is stored", spoiled_at(site::surface_depth, ndc_of_window));
    add_sphere_mistakes({all, "sphere_depth_pass"}, host);
    add_filter_mistakes({all, "depth_filter_pass"}, host);
    add_normal_mistakes({all, "normal_pass"}, host);
    Of(all, "thickness_clear_pass")
        .add("clear_left_out", "the thickness of the frame before is kept",
             mistake_at(site::is_cleared, Change::never));
    add_thickness_mistakes({all, "thickness_pass"}, host);
    add_shading_mistakes({all, "fluid_shade_pass"}, host);
    for (const char* const pass : {"encode_pass", "encode_by_gl_pass"})
        add_encoding_mistakes({all, pass});
    return all;
}

} // namespace lockstep::fluid
