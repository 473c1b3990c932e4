#include "reference/collision/collision_mistakes.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "reference/collision/collision_code.hpp"
#include "reference/collision/depth/depth_twin.hpp"
#include "reference/collision/layered_twin.hpp"
#include "reference/collision/octree/octree_twin.hpp"
#include "reference/collision/sites.hpp"

namespace lockstep {
namespace {

/// A human name of a mistake.
struct Row {
    Deviation deviation;
    const Site& site;
    Change change;
    int part = -1;
    const Site* source = nullptr;
};

/// Of the pass's arithmetic and its host, at no site.
struct WholeRow {
    Deviation deviation;
    Change change;
};
constexpr std::array whole{
    WholeRow{Deviation::matrix_of_earlier_frame, Change::handed_over},
    WholeRow{Deviation::stale_cdt, Change::handed_over},
    WholeRow{Deviation::current_frame_cdt, Change::handed_over},
    WholeRow{Deviation::buffers_not_swapped, Change::handed_over},
    WholeRow{Deviation::state_passed_through, Change::item_kept},
    WholeRow{Deviation::sums_left_to_right, Change::sums_left_to_right},
    WholeRow{Deviation::sums_right_to_left, Change::sums_right_to_left},
    WholeRow{Deviation::sums_fused, Change::sums_fused},
    WholeRow{Deviation::products_fused, Change::products_fused},
    WholeRow{Deviation::portable_arithmetic, Change::portable_arithmetic},
    WholeRow{Deviation::subnormals_kept, Change::subnormals_kept},
};

/// What a CDT of another format leaves of a position.
template <CdtFormat format> void store_and_read(std::span<float> position, const CameBy& run) {
    FrameParams params = run.foretold<FrameParams>();
    params.switches.cdt_format = format;
    const CollisionCode coarse(params);
    const glm::vec3 read = coarse.decode(coarse.encode({position[0], position[1], position[2]}));
    for (std::size_t c = 0; c < 3; ++c)
        position[c] = read[static_cast<int>(c)];
}

constexpr std::array table{
    Row{Deviation::transposed_matrix, site::proj_view, Change::transposed},
    Row{Deviation::no_perspective_divide, site::perspective_divide, Change::never},
    Row{Deviation::divide_by_half, site::half, Change::reciprocal},
    Row{Deviation::not_halved, site::half, Change::one},
    Row{Deviation::truncate_instead_of_floor, site::base_by_floor, Change::never},
    Row{Deviation::floor_instead_of_truncate, site::base_by_floor, Change::always},
    Row{Deviation::half_texel_up, site::image_position, Change::half_more},
    Row{Deviation::half_texel_down, site::image_position, Change::half_less},
    Row{Deviation::size_minus_one, site::scale, Change::one_less},
    Row{Deviation::width_and_height_swapped, site::client_size, Change::swapped},
    Row{Deviation::x_and_y_swapped, site::image_position, Change::swapped},
    Row{Deviation::x_flipped, site::texture_coordinate, Change::opposite, 0},
    Row{Deviation::y_flipped, site::texture_coordinate, Change::opposite, 1},
    Row{Deviation::collide_time_not_tested, site::searches, Change::always},
    Row{Deviation::collide_time_zero_searches, site::searches, Change::or_equal, 0},
    Row{Deviation::collide_time_test_reversed, site::searches, Change::reversed, 0},
    Row{Deviation::stands_unless_it_searches, site::stands, Change::always},
    Row{Deviation::moves_without_search, site::stands, Change::never},
    Row{Deviation::own_position_from_texel, site::own_from_texel, Change::always},
    Row{Deviation::own_position_from_vertex, site::own_from_texel, Change::never},
    Row{Deviation::phantom_origin, site::phantom, Change::always},
    Row{Deviation::empty_texels_skipped, site::phantom, Change::never},
    Row{Deviation::own_texel_not_skipped, site::own_texel_skipped, Change::never},
    Row{Deviation::own_row_skipped, site::own_texel_skipped, Change::dropped, 0},
    Row{Deviation::own_column_skipped, site::own_texel_skipped, Change::dropped, 1},
    Row{Deviation::own_row_and_column_skipped, site::own_texel_skipped, Change::and_is_or},
    Row{Deviation::first_row_skipped, site::rows, Change::first_skipped},
    Row{Deviation::first_column_skipped, site::columns, Change::first_skipped},
    Row{Deviation::last_row_skipped, site::rows, Change::last_skipped},
    Row{Deviation::last_column_skipped, site::columns, Change::last_skipped},
    Row{Deviation::radius_one_less, site::texel_collide_range, Change::one_less},
    Row{Deviation::radius_one_more, site::texel_collide_range, Change::one_more},
    Row{Deviation::outside_fetched_as_edge, site::neighbour, Change::outside_is_edge},
    Row{Deviation::outside_fetched_as_opposite_side, site::neighbour, Change::outside_is_other_side},
    Row{Deviation::outside_fetched_as_origin, site::neighbour, Change::outside_is_zero},
    Row{Deviation::zero_distance_hits, site::zero_distance_hits, Change::always},
    Row{Deviation::zero_distance_skipped, site::zero_distance_hits, Change::never},
    Row{Deviation::distance_without_z, site::distance, Change::without_z},
    Row{Deviation::squared_distance, site::distance, Change::squared},
    Row{Deviation::manhattan_distance, site::distance, Change::sum_of_magnitudes},
    Row{Deviation::range_not_tested, site::in_range, Change::dropped, 0},
    Row{Deviation::range_included, site::in_range, Change::or_equal, 0},
    Row{Deviation::last_found_instead_of_nearest, site::nearest, Change::last_taken},
    Row{Deviation::first_found_instead_of_nearest, site::nearest, Change::first_taken},
    Row{Deviation::farthest_instead_of_nearest, site::nearest, Change::greatest_taken},
    Row{Deviation::less_or_equal_for_less, site::nearest, Change::last_of_equals},
    Row{Deviation::never_collides, site::searches, Change::never},
    Row{Deviation::direction_towards_neighbour, site::away, Change::negated},
    Row{Deviation::direction_not_normalised_at_hit, site::direction_at_hit, Change::not_done},
    Row{Deviation::direction_kept_at_hit, site::direction_at_hit, Change::instead, -1, &site::direction_before},
    Row{Deviation::speed_reduced_by_instead_of_to, site::speed_factor, Change::opposite},
    Row{Deviation::speed_kept_at_hit, site::speed_at_hit, Change::instead, -1, &site::speed_before},
    Row{Deviation::speed_factor_doubled, site::speed_factor, Change::doubled},
    Row{Deviation::speed_factor_squared, site::speed_at_hit, Change::times, -1, &site::speed_factor},
    Row{Deviation::tick_missing_in_collision_step, site::step_by_tick, Change::never},
    Row{Deviation::tick_added_to_collision_step, site::step_by_tick, Change::always},
    Row{Deviation::position_kept_at_hit, site::position_at_hit, Change::instead, -1, &site::position_before},
    Row{Deviation::old_direction_moves_at_hit, site::moves_along, Change::instead, -1, &site::direction_before},
    Row{Deviation::old_speed_moves_at_hit, site::moves_by, Change::instead, -1, &site::speed_before},
    Row{Deviation::collide_time_not_set, site::collide_time_at_hit, Change::instead, -1, &site::collide_time_before},
    Row{Deviation::collide_time_counted_at_hit, site::collide_time_at_hit, Change::minus, -1, &site::tick},
    Row{Deviation::gravity_missing, site::fall, Change::zero},
    Row{Deviation::gravity_doubled, site::fall, Change::doubled},
    Row{Deviation::gravity_reversed, site::fall, Change::negated},
    Row{Deviation::gravity_without_tick, site::fall, Change::instead, -1, &site::gravity},
    Row{Deviation::tick_missing_in_move, site::move, Change::instead, -1, &site::step},
    Row{Deviation::tick_doubled, site::tick, Change::doubled},
    Row{Deviation::tick_halved, site::tick, Change::halved},
    Row{Deviation::moves_before_gravity, site::step, Change::instead, -1, &site::velocity_before},
    Row{Deviation::direction_not_updated, site::direction, Change::instead, -1, &site::direction_before},
    Row{Deviation::direction_not_normalised, site::direction, Change::not_done},
    Row{Deviation::speed_not_updated, site::speed, Change::instead, -1, &site::speed_before},
    Row{Deviation::squared_speed, site::speed, Change::squared},
    Row{Deviation::position_not_updated, site::position, Change::instead, -1, &site::position_before},
    Row{Deviation::move_reversed, site::step, Change::negated},
    Row{Deviation::collide_time_not_counted, site::collide_time, Change::instead, -1, &site::collide_time_before},
    Row{Deviation::collide_time_counted_up, site::counted, Change::negated},
    Row{Deviation::collide_time_counted_twice, site::counted, Change::doubled},
};

constexpr std::string_view octree = "octree_pass", by_depth = "depth_pass", layered = "layered_collision_pass";
const std::array searches{
    SearchMistake{octree, "itself_not_skipped", "the particle is its own neighbour",
                  mistake_at(site::itself, Change::never)},
    SearchMistake{octree, "itself_alone_searched", "every entry but the particle itself is skipped",
                  mistake_at(site::itself, Change::inverted)},
    SearchMistake{octree, "first_entry_skipped", "the leaf's first entry is not looked at",
                  mistake_at(site::entries, Change::first_skipped)},
    SearchMistake{octree, "last_entry_skipped", "the leaf's last entry is not looked at",
                  mistake_at(site::entries, Change::last_skipped)},
    SearchMistake{octree, "obstacles_not_searched", "obstacles' corners are not looked at",
                  mistake_at(site::corners, Change::never)},
    SearchMistake{octree, "only_obstacles_searched", "particles are not looked at",
                  mistake_at(site::particles, Change::never)},
    SearchMistake{octree, "obstacles_at_origin", "obstacles' corners are read as 0",
                  mistake_at(site::corner, Change::zero)},
    SearchMistake{octree, "range_reversed", "len > u_CollisionRange for <",
                  mistake_at(site::in_range, Change::reversed, 0)},
    SearchMistake{by_depth, "normal_reversed", "the normal points into the surface",
                  mistake_at(site::normal, Change::negated)},
    SearchMistake{by_depth, "thickness_not_tested", "a particle however far behind a surface hits it",
                  mistake_at(site::within_thickness, Change::always)},
    SearchMistake{by_depth, "front_is_behind", "a particle before a surface hits it",
                  mistake_at(site::behind_surface, Change::reversed, 0)},
    SearchMistake{by_depth, "thickness_in_front", "a particle before a surface hits it, too",
                  mistake_at(site::behind_surface, Change::always)},
    SearchMistake{by_depth, "behind_camera_seen", "clip w is not tested", mistake_at(site::in_front, Change::always)},
    SearchMistake{by_depth, "empty_texels_shown", "an empty texel is a surface",
                  mistake_at(site::shows_surface, Change::always)},
    SearchMistake{by_depth, "texel_corner", "a texel is unprojected at its corner",
                  mistake_at(site::texel_centre, Change::half_less)},
    SearchMistake{layered, "range_reversed", "len > u_CollisionRange for <",
                  mistake_at(site::in_range, Change::reversed, 0)},
    SearchMistake{layered, "obstacles_not_searched", "the obstacles' plane is not looked at",
                  mistake_at(site::obstacles, Change::never)},
    SearchMistake{layered, "first_layer_skipped", "layer 0 is not looked at",
                  mistake_at(site::layers, Change::first_skipped)},
    SearchMistake{layered, "last_layer_skipped", "the last layer is not looked at",
                  mistake_at(site::layers, Change::last_skipped)},
    SearchMistake{layered, "layers_from_behind", "the layers are looked at from the last to the first",
                  mistake_at(site::layers, Change::backwards)},
    SearchMistake{layered, "first_camera_skipped", "the first camera's planes are not searched",
                  mistake_at(site::cameras, Change::first_skipped)},
    SearchMistake{layered, "last_camera_skipped", "the second camera's planes are not searched",
                  mistake_at(site::cameras, Change::last_skipped)},
    SearchMistake{layered, "first_matrix_for_both", "the second camera's planes are searched with the first's matrix",
                  mistake_at(site::own_matrix, Change::never)},
    SearchMistake{layered, "second_reach_missing", "u_SecondReach is 0", mistake_at(site::second_reach, Change::zero)},
    SearchMistake{layered, "first_planes_for_both", "both cameras search the first one's planes",
                  mistake_at(site::own_planes, Change::never)},
    SearchMistake{layered, "layers_end_at_no_obstacle", "where there is no obstacle, the layers are not looked at",
                  mistake_at(site::stops_at_no_obstacle, Change::always)},
    SearchMistake{layered, "empty_texels_searched", "an empty texel is looked at",
                  mistake_at(site::holds_particle, Change::always)},
    SearchMistake{layered, "window_not_projected", "the window is u_TexelCollideRange wide, whatever the reach",
                  mistake_at(site::projected_window, Change::never)},
    SearchMistake{layered, "window_margin_missing", "the projected window lacks u_WindowMargin",
                  mistake_at(site::window_margin, Change::zero)},
    SearchMistake{layered, "reach_missing", "u_Reach is 0", mistake_at(site::reach, Change::zero)},
    SearchMistake{layered, "itself_not_skipped", "what is stored of the particle itself is its neighbour",
                  mistake_at(site::itself_skipped, Change::never)},
    SearchMistake{layered, "own_position_not_as_stored", "the distance to another is from the vertex's own position",
                  mistake_at(site::itself_stored, Change::never)},
    SearchMistake{layered, "others_always_search", "one that does not search pushes, too",
                  mistake_at(site::other_searches, Change::always)},
    SearchMistake{layered, "separating_push", "contacts that move apart are answered, too",
                  mistake_at(site::approaches, Change::always)},
    SearchMistake{layered, "approach_reversed", "contacts that move apart are answered, and no others",
                  mistake_at(site::approaches, Change::reversed, 0)},
    SearchMistake{layered, "leaving_obstacle_reflected", "one that moves away from the obstacle is reflected, too",
                  mistake_at(site::approaches_wall, Change::always)},
    SearchMistake{layered, "obstacle_never_reflects", "one that moves towards the obstacle is not reflected",
                  mistake_at(site::approaches_wall, Change::never)},
    SearchMistake{layered, "whole_push", "a particle takes the whole of a contact's impulse, not half",
                  mistake_at(site::share, Change::doubled)},
    SearchMistake{layered, "restitution_missing", "impulses are not enlarged by u_SpeedFactor",
                  mistake_at(site::speed_factor, Change::zero)},
    SearchMistake{layered, "push_reversed", "contacts pull instead of pushing",
                  mistake_at(site::share, Change::negated)},
    SearchMistake{layered, "unseen_pushed", "a particle that is in no texel is pushed, too",
                  mistake_at(site::unseen_pushed, Change::always)},
    SearchMistake{layered, "other_at_rest", "the other's velocity is left out",
                  mistake_at(site::other_velocity, Change::zero)},
    SearchMistake{layered, "last_push_alone", "of several contacts the last one counts",
                  mistake_at(site::adds_up, Change::never)},
};

} // namespace

std::span<const SearchMistake> search_mistakes() { return searches; }

std::optional<Mistake> step_mistake(Deviation deviation, const Switches& switches) {
    if (deviation == Deviation::never_collides && switches.not_searching == NotSearching::stands)
        return mistake_at(site::texel_collide_range, Change::zero);
    if (deviation == Deviation::half_cdt || deviation == Deviation::unorm8_cdt)
        return Mistake{.site = site::stored_position.id,
                       .change = Change::spoiled,
                       .formula = deviation == Deviation::half_cdt ? store_and_read<CdtFormat::rgba16f>
                                                                   : store_and_read<CdtFormat::rgba8>};
    for (const WholeRow& row : whole)
        if (row.deviation == deviation)
            return Mistake{.change = row.change,
                           .part = row.change == Change::handed_over ? static_cast<int>(deviation) : -1};
    const auto* row = std::find_if(table.begin(), table.end(), [&](const Row& r) { return r.deviation == deviation; });
    if (row == table.end())
        return {};
    return Mistake{.site = row->site.id,
                   .change = row->change,
                   .part = row->part,
                   .source = row->source != nullptr ? row->source->id : 0};
}

std::vector<Mistake> mistakes_of(const Deviations& deviations, const Switches& switches) {
    std::vector<Mistake> made;
    for (const Deviation deviation : deviations)
        if (const auto mistake = step_mistake(deviation, switches))
            made.push_back(*mistake);
    return made;
}

bool can_make(std::string_view pass, const Mistake& mistake) {
    const std::uint32_t site = mistake.site;
    if (pass != "collision_pass" && (site == 0 || mistake.change == Change::spoiled))
        return false;
    using namespace lockstep::site;
    static constexpr std::array<std::uint32_t, 13> of_listing{stands.id,
                                                              perspective_divide.id,
                                                              half.id,
                                                              base_by_floor.id,
                                                              scale.id,
                                                              texture_coordinate.id,
                                                              own_from_texel.id,
                                                              own_texel.id,
                                                              own_texel_skipped.id,
                                                              neighbour.id,
                                                              phantom.id,
                                                              own_position.id,
                                                              zero_distance_hits.id};
    static constexpr std::array<std::uint32_t, 14> of_images{
        proj_view.id, client_size.id,     texel_collide_range.id, clip.id,           ndc.id,
        rows.id,      columns.id,         image_position.id,      holds_particle.id, stored.id,
        box_low.id,   stored_position.id, scaled_to_box.id,       base_texel.id};
    static constexpr std::array<std::uint32_t, 21> not_of_depth{stands.id,
                                                                own_from_texel.id,
                                                                own_texel.id,
                                                                own_position.id,
                                                                own_texel_skipped.id,
                                                                rows.id,
                                                                columns.id,
                                                                texel_collide_range.id,
                                                                neighbour.id,
                                                                phantom.id,
                                                                nearest.id,
                                                                holds_particle.id,
                                                                stored.id,
                                                                box_low.id,
                                                                stored_position.id,
                                                                distance.id,
                                                                zero_distance_hits.id,
                                                                collision_range.id,
                                                                in_range.id,
                                                                scaled_to_box.id,
                                                                away.id};
    const auto among = [&](const auto& sites) { return std::find(sites.begin(), sites.end(), site) != sites.end(); };
    if (pass == "collision_pass")
        return true;
    if (pass == "depth_pass")
        return !among(not_of_depth);
    if (pass == "octree_pass" && site == zero_distance_hits.id)
        return true;
    return !among(of_listing) && !(pass == "octree_pass" && among(of_images));
}

} // namespace lockstep
