#include "reference/collision/deviation.hpp"

#include <array>

namespace lockstep {
namespace {

using enum Deviation;

constexpr std::array table{
    DeviationInfo{transposed_matrix, "transposed_matrix", "u_ProjView is transposed"},
    DeviationInfo{matrix_of_earlier_frame, "matrix_of_earlier_frame", "u_ProjView is still the frame before's"},
    DeviationInfo{no_perspective_divide, "no_perspective_divide", "clip xy is not divided by w"},
    DeviationInfo{divide_by_half, "divide_by_half", "(ndc + 1) / 0.5 for (ndc + 1) * 0.5"},
    DeviationInfo{not_halved, "not_halved", "(ndc + 1) without * 0.5"},
    DeviationInfo{truncate_instead_of_floor, "truncate_instead_of_floor", "base texel: ivec2() for floor"},
    DeviationInfo{floor_instead_of_truncate, "floor_instead_of_truncate", "base texel: floor for ivec2()"},
    DeviationInfo{half_texel_up, "half_texel_up", "base texel: 0.5 added, or rounded to nearest"},
    DeviationInfo{half_texel_down, "half_texel_down", "base texel: 0.5 subtracted"},
    DeviationInfo{size_minus_one, "size_minus_one", "base texel: scaled by size - 1"},
    DeviationInfo{width_and_height_swapped, "width_and_height_swapped", "u_ClientWidth and u_ClientHeight are swapped"},
    DeviationInfo{x_and_y_swapped, "x_and_y_swapped", "base texel: x and y are swapped"},
    DeviationInfo{x_flipped, "x_flipped", "base texel: 1 - x"},
    DeviationInfo{y_flipped, "y_flipped", "base texel: 1 - y"},
    DeviationInfo{collide_time_not_tested, "collide_time_not_tested", "every particle searches"},
    DeviationInfo{collide_time_zero_searches, "collide_time_zero_searches", "searches at collide time <= 0"},
    DeviationInfo{collide_time_test_reversed, "collide_time_test_reversed", "searches at collide time > 0"},
    DeviationInfo{own_position_from_texel, "own_position_from_texel", "own position is the base texel's"},
    DeviationInfo{own_position_from_vertex, "own_position_from_vertex", "own position is the vertex's"},
    DeviationInfo{phantom_origin, "phantom_origin", "an empty texel is a particle at the origin"},
    DeviationInfo{empty_texels_skipped, "empty_texels_skipped", "an empty texel is no particle"},
    DeviationInfo{own_texel_not_skipped, "own_texel_not_skipped", "the base texel is a neighbour"},
    DeviationInfo{own_row_skipped, "own_row_skipped", "the base texel's row is skipped"},
    DeviationInfo{own_column_skipped, "own_column_skipped", "the base texel's column is skipped"},
    DeviationInfo{own_row_and_column_skipped, "own_row_and_column_skipped", "tx == 0 || ty == 0 for &&"},
    DeviationInfo{first_row_skipped, "first_row_skipped", "ty from -range + 1"},
    DeviationInfo{first_column_skipped, "first_column_skipped", "tx from -range + 1"},
    DeviationInfo{last_row_skipped, "last_row_skipped", "ty < range for <="},
    DeviationInfo{last_column_skipped, "last_column_skipped", "tx < range for <="},
    DeviationInfo{radius_one_less, "radius_one_less", "u_TexelCollideRange - 1"},
    DeviationInfo{radius_one_more, "radius_one_more", "u_TexelCollideRange + 1"},
    DeviationInfo{outside_fetched_as_edge, "outside_fetched_as_edge", "texels outside are those of the edge"},
    DeviationInfo{outside_fetched_as_opposite_side, "outside_fetched_as_opposite_side", "texels outside wrap round"},
    DeviationInfo{outside_fetched_as_origin, "outside_fetched_as_origin", "texels outside hold the origin"},
    DeviationInfo{zero_distance_hits, "zero_distance_hits", "a neighbour at distance 0 is a hit"},
    DeviationInfo{zero_distance_skipped, "zero_distance_skipped", "a neighbour at distance 0 is skipped"},
    DeviationInfo{distance_without_z, "distance_without_z", "distance in x and y"},
    DeviationInfo{squared_distance, "squared_distance", "squared distance against the range"},
    DeviationInfo{manhattan_distance, "manhattan_distance", "|x| + |y| + |z| for the distance"},
    DeviationInfo{range_not_tested, "range_not_tested", "any distance is within the collision range"},
    DeviationInfo{range_included, "range_included", "range >= distance for >"},
    DeviationInfo{last_found_instead_of_nearest, "last_found_instead_of_nearest", "the last in range, not the nearest"},
    DeviationInfo{first_found_instead_of_nearest, "first_found_instead_of_nearest",
                  "the first in range, not the nearest"},
    DeviationInfo{farthest_instead_of_nearest, "farthest_instead_of_nearest", "the farthest in range"},
    DeviationInfo{less_or_equal_for_less, "less_or_equal_for_less", "distance <= best for <: the last of equals"},
    DeviationInfo{stale_cdt, "stale_cdt", "reads the CDT that the frame before read"},
    DeviationInfo{current_frame_cdt, "current_frame_cdt", "reads the CDT that is being drawn"},
    DeviationInfo{half_cdt, "half_cdt", "CDT in half floats"},
    DeviationInfo{unorm8_cdt, "unorm8_cdt", "CDT in bytes"},
    DeviationInfo{never_collides, "never_collides", "no particle collides"},
    DeviationInfo{direction_towards_neighbour, "direction_towards_neighbour", "at a hit: towards, not away"},
    DeviationInfo{direction_not_normalised_at_hit, "direction_not_normalised_at_hit", "at a hit: no normalize"},
    DeviationInfo{direction_kept_at_hit, "direction_kept_at_hit", "at a hit: the old direction"},
    DeviationInfo{speed_reduced_by_instead_of_to, "speed_reduced_by_instead_of_to", "speed * (1 - factor)"},
    DeviationInfo{speed_kept_at_hit, "speed_kept_at_hit", "at a hit: the old speed"},
    DeviationInfo{speed_factor_doubled, "speed_factor_doubled", "speed * 2 * factor"},
    DeviationInfo{speed_factor_squared, "speed_factor_squared", "speed * factor * factor"},
    DeviationInfo{tick_missing_in_collision_step, "tick_missing_in_collision_step", "at a hit: moves by dir * speed"},
    DeviationInfo{tick_added_to_collision_step, "tick_added_to_collision_step",
                  "at a hit: moves by dir * speed * tick"},
    DeviationInfo{position_kept_at_hit, "position_kept_at_hit", "at a hit: does not move"},
    DeviationInfo{old_direction_moves_at_hit, "old_direction_moves_at_hit", "at a hit: moves along the old direction"},
    DeviationInfo{old_speed_moves_at_hit, "old_speed_moves_at_hit", "at a hit: moves by the old speed"},
    DeviationInfo{collide_time_not_set, "collide_time_not_set", "at a hit: collide time stays"},
    DeviationInfo{collide_time_counted_at_hit, "collide_time_counted_at_hit", "at a hit: collision time - tick"},
    DeviationInfo{gravity_missing, "gravity_missing", "no gravity"},
    DeviationInfo{gravity_doubled, "gravity_doubled", "2 * gravity"},
    DeviationInfo{gravity_reversed, "gravity_reversed", "-gravity"},
    DeviationInfo{gravity_without_tick, "gravity_without_tick", "gravity without * tick"},
    DeviationInfo{tick_missing_in_move, "tick_missing_in_move", "position + dir * speed without * tick"},
    DeviationInfo{tick_doubled, "tick_doubled", "2 * tick"},
    DeviationInfo{tick_halved, "tick_halved", "tick / 2"},
    DeviationInfo{moves_before_gravity, "moves_before_gravity", "moves by the velocity before gravity"},
    DeviationInfo{direction_not_updated, "direction_not_updated", "no hit: the old direction"},
    DeviationInfo{direction_not_normalised, "direction_not_normalised", "no hit: no normalize"},
    DeviationInfo{speed_not_updated, "speed_not_updated", "no hit: the old speed"},
    DeviationInfo{squared_speed, "squared_speed", "no hit: the squared length of the velocity"},
    DeviationInfo{position_not_updated, "position_not_updated", "no hit: does not move"},
    DeviationInfo{move_reversed, "move_reversed", "no hit: moves backwards"},
    DeviationInfo{collide_time_not_counted, "collide_time_not_counted", "collide time without - tick"},
    DeviationInfo{collide_time_counted_up, "collide_time_counted_up", "collide time + tick"},
    DeviationInfo{collide_time_counted_twice, "collide_time_counted_twice", "collide time - 2 * tick"},
    DeviationInfo{buffers_not_swapped, "buffers_not_swapped", "starts from the particles of the frame before"},
    DeviationInfo{state_passed_through, "state_passed_through", "the state before is the state after"},
    DeviationInfo{sums_left_to_right, "sums_left_to_right", "dot as (x + y) + z"},
    DeviationInfo{sums_right_to_left, "sums_right_to_left", "dot as x + (y + z)"},
    DeviationInfo{sums_fused, "sums_fused", "dot as fma(z, fma(y, x))"},
    DeviationInfo{products_fused, "products_fused", "a * b + c in one rounding"},
    DeviationInfo{portable_arithmetic, "portable_arithmetic", "arithmetic=exact for plain"},
    DeviationInfo{subnormals_kept, "subnormals_kept", "subnormals are not flushed to 0"},
    DeviationInfo{point_without_divide, "point_without_divide", "drawn with w = 1"},
    DeviationInfo{point_of_position_before, "point_of_position_before", "drawn where the particle was"},
    DeviationInfo{point_of_position_after, "point_of_position_after", "drawn where the particle is now"},
    DeviationInfo{point_y_flipped, "point_y_flipped", "drawn upside down"},
    DeviationInfo{point_half_pixel_up, "point_half_pixel_up", "drawn half a pixel further right and up"},
    DeviationInfo{point_half_pixel_down, "point_half_pixel_down", "drawn half a pixel further left and down"},
    DeviationInfo{point_on_upper_pixel, "point_on_upper_pixel", "a point on a pixel's edge is the upper pixel's"},
    DeviationInfo{point_viewport_swapped, "point_viewport_swapped", "viewport's width and height are swapped"},
    DeviationInfo{depth_greater, "depth_greater", "depth test GREATER"},
    DeviationInfo{depth_not_tested, "depth_not_tested", "no depth test: the last particle stays"},
    DeviationInfo{depth_equal_passes, "depth_equal_passes", "depth test LEQUAL"},
    DeviationInfo{depth_not_cleared, "depth_not_cleared", "depth of the frame before is still there"},
    DeviationInfo{cdt_not_cleared, "cdt_not_cleared", "texels of two frames before are still there"},
    DeviationInfo{cdt_not_drawn, "cdt_not_drawn", "no particle is drawn"},
    DeviationInfo{obstacles_not_drawn, "obstacles_not_drawn", "no obstacle is drawn"},
    DeviationInfo{obstacles_never_hide, "obstacles_never_hide", "particles are drawn over obstacles"},
    DeviationInfo{stores_position_before, "stores_position_before", "stores where the particle was"},
    DeviationInfo{stores_direction, "stores_direction", "stores the direction"},
    DeviationInfo{alpha_missing, "alpha_missing", "stores alpha 0"},
};
static_assert(table.size() == deviation_count);

constexpr bool in_order() {
    for (std::size_t i = 0; i < table.size(); ++i)
        if (static_cast<std::size_t>(table[i].deviation) != i)
            return false;
    return true;
}
static_assert(in_order());

} // namespace

std::span<const DeviationInfo> deviation_table() { return table; }

std::string_view deviation_name(Deviation deviation) { return table[static_cast<std::size_t>(deviation)].name; }

} // namespace lockstep
