#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace lockstep {

/// Mistakes that a shader or its host may make; the reference can make them too (deviating_pass.hpp), to see whether
/// one explains what a GPU did. In the order of the listing.
enum class Deviation {
    transposed_matrix,
    matrix_of_earlier_frame,
    no_perspective_divide,
    divide_by_half,
    not_halved,
    truncate_instead_of_floor,
    floor_instead_of_truncate,
    half_texel_up,
    half_texel_down,
    size_minus_one,
    width_and_height_swapped,
    x_and_y_swapped,
    x_flipped,
    y_flipped,
    collide_time_not_tested,
    collide_time_zero_searches,
    collide_time_test_reversed,
    stands_unless_it_searches,
    moves_without_search,
    own_position_from_texel,
    own_position_from_vertex,
    phantom_origin,
    empty_texels_skipped,
    own_texel_not_skipped,
    own_row_skipped,
    own_column_skipped,
    own_row_and_column_skipped,
    first_row_skipped,
    first_column_skipped,
    last_row_skipped,
    last_column_skipped,
    radius_one_less,
    radius_one_more,
    outside_fetched_as_edge,
    outside_fetched_as_opposite_side,
    outside_fetched_as_origin,
    zero_distance_hits,
    zero_distance_skipped,
    distance_without_z,
    squared_distance,
    manhattan_distance,
    range_not_tested,
    range_included,
    last_found_instead_of_nearest,
    first_found_instead_of_nearest,
    farthest_instead_of_nearest,
    less_or_equal_for_less,
    stale_cdt,
    current_frame_cdt,
    half_cdt,
    unorm8_cdt,
    never_collides,
    direction_towards_neighbour,
    direction_not_normalised_at_hit,
    direction_kept_at_hit,
    speed_reduced_by_instead_of_to,
    speed_kept_at_hit,
    speed_factor_doubled,
    speed_factor_squared,
    tick_missing_in_collision_step,
    tick_added_to_collision_step,
    position_kept_at_hit,
    old_direction_moves_at_hit,
    old_speed_moves_at_hit,
    collide_time_not_set,
    collide_time_counted_at_hit,
    gravity_missing,
    gravity_doubled,
    gravity_reversed,
    gravity_without_tick,
    tick_missing_in_move,
    tick_doubled,
    tick_halved,
    moves_before_gravity,
    direction_not_updated,
    direction_not_normalised,
    speed_not_updated,
    squared_speed,
    position_not_updated,
    move_reversed,
    collide_time_not_counted,
    collide_time_counted_up,
    collide_time_counted_twice,
    buffers_not_swapped,
    state_passed_through,
    sums_left_to_right,
    sums_right_to_left,
    sums_fused,
    products_fused,
    portable_arithmetic,
    subnormals_kept,
    // What follows shows in texels only: where the point is drawn and what it leaves there.
    point_without_divide,
    point_of_position_before,
    point_of_position_after,
    point_y_flipped,
    point_half_pixel_up,
    point_half_pixel_down,
    point_on_upper_pixel,
    point_viewport_swapped,
    depth_greater,
    depth_not_tested,
    depth_equal_passes,
    depth_not_cleared,
    cdt_not_cleared,
    cdt_not_drawn,
    obstacles_not_drawn,
    obstacles_never_hide,
    stores_position_before,
    stores_direction,
    alpha_missing,
    // Other ways to write the fragment stage. Every image with a point shows them: power does not count them.
    stores_half_floats,
    stores_srgb,
    stores_clamped,
    stores_x_and_y_swapped,
    stores_y_and_z_swapped,
    stores_x_and_z_swapped,
    alpha_is_depth,
    point_depth_constant,
    point_depth_reversed,
    fragment_depth_reversed,
    negative_x_discarded,
    negative_y_discarded,
    negative_z_discarded,
    position_interpolated,
    point_of_position_before_at_hit,
    point_flat,
    point_half_pixel_right,
    point_half_pixel_left,
    point_half_pixel_higher,
    point_half_pixel_lower,
    point_x_flipped,
    point_x_and_y_swapped,
    point_pixel_right,
    point_pixel_left,
    point_pixel_up,
    point_pixel_down,
    point_depth_zero_to_one,
    point_depth_doubled,
    point_depth_clamped,
    fragment_depth_zero,
    stores_negated,
    stores_x_negated,
    stores_y_negated,
    stores_z_negated,
    stores_remapped,
    alpha_is_speed,
    alpha_is_collide_time,
    waiting_discarded,
    near_half_discarded,
    only_upper_right_drawn,
    checkerboard_discarded,
    point_shift_without_w,
    stores_window_coordinates,
    stores_clip_space,
    stores_ndc,
    stores_in_steps,
    stores_size,
    // Of the obstacles, where they are drawn as triangles.
    obstacle_first_and_second_swapped,
    obstacle_second_and_third_swapped,
    obstacle_first_and_third_swapped,
    obstacle_corners_rotated,
    obstacle_corners_rotated_back,
    obstacle_shares_exchanged,
    obstacle_first_corner_alone,
    obstacle_last_corner_alone,
    obstacle_centroid_alone,
    obstacle_stores_clip_space,
    obstacle_stores_ndc,
    obstacle_at_pixel_corner,
    obstacle_interpolated_on_screen,
    obstacle_y_flipped,
    obstacle_x_flipped,
    obstacle_depth_not_halved,
    obstacle_depth_zero,
    obstacle_depth_reversed,
    obstacle_counterclockwise_alone,
    obstacle_clockwise_alone,
    obstacle_alpha_missing,
};
inline constexpr std::size_t deviation_count = static_cast<std::size_t>(Deviation::obstacle_alpha_missing) + 1;

/// Whether a run's power is asked about it.
constexpr bool counts_in_power(Deviation deviation) { return deviation <= Deviation::alpha_missing; }

/// Whether obstacles are drawn otherwise than they should be.
constexpr bool changes_obstacles(Deviation deviation) {
    return deviation >= Deviation::obstacle_first_and_second_swapped;
}

/// Whether it changes a particle's step.
constexpr bool changes_step(Deviation deviation) { return deviation < Deviation::point_without_divide; }

/// Whether it changes what is drawn of given particles. With arithmetic=exact the pass itself finds the texel a point
/// is drawn to (`places_points`).
constexpr bool changes_drawing(Deviation deviation, bool places_points) {
    using enum Deviation;
    if (places_points && deviation >= no_perspective_divide && deviation <= y_flipped)
        return true;
    return !changes_step(deviation) || deviation == transposed_matrix || deviation == matrix_of_earlier_frame ||
           deviation == half_cdt || deviation == unorm8_cdt || deviation == products_fused ||
           deviation == portable_arithmetic;
}

struct DeviationInfo {
    Deviation deviation;
    std::string_view name;
    std::string_view meaning;
};

/// All of them, in order.
std::span<const DeviationInfo> deviation_table();
std::string_view deviation_name(Deviation deviation);

/// A few at once.
class Deviations {
  public:
    static constexpr std::size_t most = 4;

    Deviations() = default;
    Deviations(Deviation one) { add(one); }
    Deviations& add(Deviation one) {
        if (!has(one))
            made_.at(count_++) = one;
        return *this;
    }
    [[nodiscard]] bool has(Deviation one) const {
        for (const Deviation made : *this)
            if (made == one)
                return true;
        return false;
    }
    [[nodiscard]] const Deviation* begin() const { return made_.data(); }
    [[nodiscard]] const Deviation* end() const { return made_.data() + count_; }

  private:
    std::array<Deviation, most> made_{};
    std::size_t count_ = 0;
};

} // namespace lockstep
