#include "crosscheck/fluid/mistake_lists.hpp"

#include "reference/fluid/sites.hpp"

namespace lockstep::fluid {
namespace {

/// Where a normal has no length its pixel is empty.
void encoded(Words normal, const CameBy& /*run*/) {
    for (std::size_t c = 0; c < 3 && normal[3] != 0.0F; ++c)
        normal[c] = normal[c] * 0.5F + 0.5F;
}
void at_a_metre(Words point, const CameBy& run) {
    point[0] = first(run, site::slope_x);
    point[1] = first(run, site::slope_y);
}
void turned_to_eye(Words point, const CameBy& /*run*/) {
    point[0] = -point[0];
    point[1] = -point[1];
}

} // namespace

void add_ray_mistakes(Of of, const Host& host) {
    static const Mistake second_slope = spoiled_at(site::unit_slope_y, second_given);
    of.add("rays_of_corners", "rays go through pixels' corners", mistake_at(site::ray_of_centre, Change::never))
        .add("rays_upside_down", "y of rays is negated", mistake_at(site::slope_y, Change::negated))
        .add("aspect_left_out", "rays lean as far along x as along y", given(site::unit_slope_x, {host.slope().y}))
        .add("slope_turned", "P00 and P11 are taken for their reciprocals",
             with(given(site::unit_slope_x, {host.projection()[0][0], host.projection()[1][1]}), second_slope));
}

void add_point_mistakes(Of of, const Host& host) {
    add_ray_mistakes(of, host);
    of.add("points_at_a_metre", "x and y of points are those at a metre", spoiled_at(site::point, at_a_metre))
        .add("points_turned", "x and y of points are negated", spoiled_at(site::point, turned_to_eye))
        .add("depth_not_decoded", "what is stored is taken for a depth in view space",
             mistake_at(site::decodes, Change::never))
        .add("decoded_turned", "decoded depths lie behind the camera", mistake_at(site::decoded, Change::negated))
        .add("filter_not_read", "the spheres' depth is read, not the filtered one",
             mistake_at(site::reads_filtered, Change::never));
}

void add_normal_mistakes(Of of, const Host& host) {
    static const Mistake below_turned = mistake_at(site::step_up, Change::negated),
                         above_turned = mistake_at(site::step_above, Change::negated);
    of.add("cross_turned", "the factors of the cross product are swapped", mistake_at(site::cross, Change::negated))
        .add("right_for_left", "the other side is taken along x", mistake_at(site::right_side, Change::inverted))
        .add("right_always", "the right side is taken everywhere", mistake_at(site::right_side, Change::always))
        .add("left_always", "the left side is taken everywhere", mistake_at(site::right_side, Change::never))
        .add("up_for_down", "the other side is taken along y", mistake_at(site::upper_side, Change::inverted))
        .add("left_turned", "steps from the left are turned", mistake_at(site::step_left, Change::negated))
        .add("lower_turned", "steps from below are turned", mistake_at(site::step_up, Change::negated))
        .add("steps_back_turned", "steps from the left and from below are turned",
             with(mistake_at(site::step_left, Change::negated), below_turned))
        .add("steps_on_turned", "steps to the right and upwards are turned",
             with(mistake_at(site::step_right, Change::negated), above_turned))
        .add("right_is_left", "the left neighbour is read for the right one",
             mistake_at(site::right_is_right, Change::never))
        .add("left_is_right", "the right neighbour is read for the left one",
             mistake_at(site::left_is_left, Change::never))
        .add("upper_is_lower", "the lower neighbour is read for the upper one",
             mistake_at(site::upper_is_above, Change::never))
        .add("lower_is_upper", "the upper neighbour is read for the lower one",
             mistake_at(site::lower_is_below, Change::never))
        .add("farther_picked", "of two neighbours the farther is taken", mistake_at(site::picks_nearer, Change::never))
        .add("facing_away", "where no side is the normal points away", mistake_at(site::facing, Change::negated))
        .add("normal_not_unit", "normals are as long as the cross product", mistake_at(site::normal, Change::not_done))
        .add("edges_not_facing", "what is beyond an edge is taken for a neighbour",
             mistake_at(site::faces_at_edges, Change::never))
        .add("empty_has_normal", "pixels without fluid have a normal", mistake_at(site::centre_empty, Change::never))
        .add("normal_x_turned", "x of normals is negated", mistake_at(site::normal, Change::negated, 0))
        .add("normal_y_turned", "y of normals is negated", mistake_at(site::normal, Change::negated, 1))
        .add("normal_xy_swapped", "x and y of normals are swapped", mistake_at(site::normal, Change::swapped))
        .add("depth_as_ndc", "what is stored is taken for NDC depth", mistake_at(site::reads_ndc, Change::always));
    add_point_mistakes(of, host);
    of.add("up_always", "the upper side is taken everywhere", mistake_at(site::upper_side, Change::always))
        .add("down_always", "the lower side is taken everywhere", mistake_at(site::upper_side, Change::never))
        .add("facing_left_out", "where no side is there is no normal", mistake_at(site::facing, Change::zero))
        .add("steps_of_two", "steps are those from one neighbour to the other",
             mistake_at(site::one_sided, Change::never))
        .add("neighbours_on_one_ray", "neighbours lie on the pixel's own ray",
             mistake_at(site::on_own_ray, Change::never))
        .add("normal_encoded", "normals are stored from 0 to 1", spoiled_at(site::normal, encoded))
        .add("normal_z_turned", "z of normals is negated", mistake_at(site::normal, Change::negated, 2));
}

} // namespace lockstep::fluid
