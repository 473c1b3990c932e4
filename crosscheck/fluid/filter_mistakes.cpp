#include "crosscheck/fluid/mistake_lists.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/fluid/sites.hpp"

namespace lockstep::fluid {
namespace {

/// A loop whose first turn is not 1 goes to both sides of the pixel.
bool is_of_both_sides(Words loop) { return loop[0] < 0.0F; }

void shorter_at_both_ends(Words loop, const CameBy& /*run*/) {
    loop[0] += 1.0F;
    loop[1] -= 1.0F;
}
void longer_at_the_ends(Words loop, const CameBy& /*run*/) {
    loop[1] = std::min(loop[1] + 1.0F, static_cast<float>(most_filter_radius));
    if (is_of_both_sides(loop))
        loop[0] = -loop[1];
}
void half_as_long(Words loop, const CameBy& /*run*/) {
    loop[1] = std::floor(loop[1] * 0.5F);
    loop[0] = -loop[1];
}

void raised_to_given(Words value, const CameBy& run) { value[0] = std::pow(value[0], run.constants[0]); }
void exponent_to_2(Words value, const CameBy& /*run*/) { value[0] *= std::numbers::ln2_v<float>; }
void root_of_magnitude(Words value, const CameBy& /*run*/) { value[0] = std::sqrt(std::abs(value[0])); }
void one_more_sample(Words value, const CameBy& run) { value[0] = first(run, site::sum_of_weights) + 1.0F; }
void four_times(Words value, const CameBy& /*run*/) { value[0] *= 4.0F; }

void without_depth_term(Words value, const CameBy& run) {
    const float cx = first(run, site::flow_scale_x), cy = first(run, site::flow_scale_y), zx = first(run, site::zx),
                zy = first(run, site::zy);
    value[0] = (cy * cy) * (zx * zx) + (cx * cx) * (zy * zy);
}
void ex_not_halved(Words value, const CameBy& run) {
    value[0] = first(run, site::zx) * first(run, site::fx) - first(run, site::zxx) * first(run, site::e0);
}
void ey_not_halved(Words value, const CameBy& run) {
    value[0] = first(run, site::zy) * first(run, site::fy) - first(run, site::zyy) * first(run, site::e0);
}

void of_means(Of& of, const Host& host) {
    of.add_description("decoded_behind", "decoded depths lie behind the camera",
                       mistake_at(site::decoded, Change::negated));
    of.add("filter_begins_anew", "each step filters the spheres' depth",
           mistake_at(site::reads_spheres, Change::always))
        .add("spheres_not_filtered", "the first step filters what the frame before left",
             mistake_at(site::reads_spheres, Change::never))
        .add("edge_is_0", "beyond the image's edge depths are 0", mistake_at(site::ends_at_edge, Change::never))
        .add("centre_left_out", "the pixel itself is left out", mistake_at(site::takes_centre, Change::never))
        .add("reach_one_more", "the filter reaches one pixel further", ranged_at(site::samples, longer_at_the_ends))
        .add("all_weights_one", "the sum is divided by the number of samples",
             spoiled_at(site::sum_of_weights, one_more_sample))
        .add("range_not_in_sum", "the weights alone have those of the range",
             mistake_at(site::range_in_sum, Change::never))
        .add("range_not_in_weights", "the sum alone has the weights of the range",
             mistake_at(site::range_in_weights, Change::never))
        .add("range_not_squared", "the step in depth is not squared", mistake_at(site::range_is_squared, Change::never))
        .add("range_by_magnitude", "range weights fall with the step, not with its square",
             formula_at(site::range_step, root_of_magnitude))
        .add("range_weight_squared", "range weights are squared",
             mistake_at(site::range_weight, Change::times, -1, &site::range_weight))
        .add("range_by_blur_scale", "steps in depth are scaled as those on the image",
             given(site::range_scale, {host.blur_scale()}))
        .add("range_scale_not_squared", "the square of the step in depth is scaled once",
             formula_at(site::range_scale, root_of_magnitude))
        .add("range_sigma", "range weights are of another sigma; their scale is multiplied",
             formula_at(site::range_scale, scaled_by_given),
             {{std::numbers::sqrt2_v<float>}, {1.0F / std::numbers::sqrt2_v<float>}, {3.0F}, {1.0F / 3.0F}})
        .add("spatial_sigma", "weights are of another sigma; their exponent is multiplied",
             formula_at(site::weight, raised_to_given),
             {{2.0F}, {0.5F}, {9.0F}, {4.0F / 9.0F}, {1.0F / 9.0F}, {9.0F / 4.0F}})
        .add("base_of_2", "powers of 2 are taken for those of e", formula_at(site::exponent, exponent_to_2))
        .add("depth_as_ndc", "window depth is taken for NDC depth", mistake_at(site::window_is_ndc, Change::always))
        .add("depth_not_coded", "what is filtered is stored as it is", instead_of(site::smooth_depth, site::mean))
        .add("empty_weighs", "empty samples have a weight, and no depth",
             mistake_at(site::empty_weighs, Change::always))
        .add("sum_from_centre", "the sum begins with the pixel's own depth",
             mistake_at(site::sum_from_0, Change::never))
        .add("weights_from_1", "the weights begin with 1", mistake_at(site::weights_from_0, Change::never))
        .add("stops_at_empty", "the filter stops at an empty sample", mistake_at(site::empty, Change::loop_left_if_so))
        .add("samples_diagonal", "samples lie on the diagonal", mistake_at(site::blur_direction, Change::one));
}

/// Of filters whose reach is the host's: of few samples these are others of narrow_range.
void of_given_reach(Of& of) {
    of.add("radius_is_width", "the filter's radius is taken for its width", ranged_at(site::samples, half_as_long))
        .add("samples_two_apart", "samples are two pixels apart", mistake_at(site::blur_direction, Change::doubled));
}

void of_narrow_range(Of& of) {
    of.add("range_turned", "samples that are too far are refused, and those too near drawn in",
           mistake_at(site::refuses_near, Change::never))
        .add("drawn_in_to_range", "samples that are too far are drawn in to the range",
             mistake_at(site::drawn_to_centre, Change::never))
        .add("range_of_last_sample", "the range is that around the last sample",
             mistake_at(site::range_is_kept, Change::never))
        .add("near_drawn_in", "samples that are too near are drawn in to the range",
             mistake_at(site::near_is_refused, Change::never))
        .add("far_refused", "samples that are too far are refused", mistake_at(site::far_is_kept, Change::never))
        .add("empty_refused", "empty samples are refused", mistake_at(site::empty_is_far, Change::never))
        .add("judged_from_last", "of samples that are judged together the last is judged first",
             mistake_at(site::judges_from_first, Change::never))
        .add("rows_first", "the clean-up goes row by row, not column by column",
             mistake_at(site::columns_first, Change::never))
        .add("one_range", "both sides of the pixel have one range", mistake_at(site::two_ranges, Change::never))
        .add("reach_rounded_down", "the filter's reach is rounded down",
             mistake_at(site::reach_is_ceiling, Change::never))
        .add("rows_not_weighed", "weights leave out the rows", mistake_at(site::weighs_rows, Change::never));
}

void of_flow(Of& of, const Host& host) {
    static const Mistake zy_doubled = mistake_at(site::zy, Change::doubled),
                         ey_whole = formula_at(site::ey, ey_not_halved),
                         fy_halved = mistake_at(site::fy, Change::halved),
                         cy_halved = mistake_at(site::flow_scale_y, Change::halved),
                         cy_given = formula_at(site::flow_scale_y, second_given);
    const auto of_pixels = [](int pixels) { return 2.0F / static_cast<float>(pixels); };
    of.add("flow_slopes_doubled", "slopes over two pixels are not halved",
           with(mistake_at(site::zx, Change::doubled), zy_doubled))
        .add("flow_slopes_to_one_side", "slopes are to the next pixel alone",
             mistake_at(site::slopes_of_two, Change::never))
        .add("flow_over_gaps", "derivatives are taken where neighbours are missing",
             mistake_at(site::needs_both_sides, Change::never))
        .add("flow_reach_one_way", "neighbours may be as far behind as they are",
             mistake_at(site::reach_is_two_way, Change::never))
        .add("flow_derivatives_halved", "the derivatives of the root are not doubled",
             with(mistake_at(site::fx, Change::halved), fy_halved))
        .add("flow_middle_once", "second derivatives take the middle once",
             mistake_at(site::takes_middle_twice, Change::never))
        .add("flow_mixed_not_quartered", "the mixed derivative is not quartered", spoiled_at(site::zxy, four_times))
        .add("flow_mixed_halved", "the mixed derivative is halved, not quartered",
             mistake_at(site::zxy, Change::doubled))
        .add("curvature_not_halved", "the curvature is that of both axes together, not their mean",
             mistake_at(site::curvature, Change::doubled))
        .add("flow_step_doubled", "a step is twice as long", mistake_at(site::flow_step, Change::doubled))
        .add("flow_mixed_turned", "the mixed derivative is negated", mistake_at(site::zxy, Change::negated))
        .add("flow_without_depth", "the term of the depth itself is left out", spoiled_at(site::e0, without_depth_term))
        .add("flow_not_halved", "the derivatives of the root are not halved",
             with(formula_at(site::ex, ex_not_halved), ey_whole))
        .add("flow_not_rooted", "the curvature is divided by 2 E E", mistake_at(site::e0_root, Change::not_done))
        .add("flow_scale_halved", "pixels are taken for half their size",
             with(mistake_at(site::flow_scale_x, Change::halved), cy_halved))
        .add("flow_without_angle", "the size of pixels leaves out the camera's angle",
             with(formula_at(site::flow_scale_x, as_given,
                             {of_pixels(host.settings().width), of_pixels(host.settings().height)}),
                  cy_given));
}

} // namespace

void add_filter_mistakes(Of of, const Host& host) {
    add_depth_mistakes(of, host);
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
             ranged_at(site::samples, shorter_at_both_ends))
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
    of_means(of, host);
    if (host.switches().filter == Filter::narrow_range)
        of_narrow_range(of);
    else if (host.switches().filter == Filter::curvature_flow)
        of_flow(of, host);
    else
        of_given_reach(of);
}

} // namespace lockstep::fluid
