#include "crosscheck/lights/volume_mistakes.hpp"

#include <cmath>
#include <cstddef>

#include "crosscheck/lights/mistake_words.hpp"
#include "reference/lights/light_order.hpp"
#include "reference/lights/sites.hpp"

namespace lockstep::lights {
namespace {

Mistake tried(WronglyTried which) { return {.change = Change::handed_over, .part = static_cast<int>(which)}; }

void falloff_by_share(Words value, const CameBy& run) { value[0] = 1.0F - first(run, site::ratio); }
void falloff_not_squared(Words value, const CameBy& run) {
    value[0] = first(run, site::falloff) / first(run, site::denominator);
}
void red_is_green(Words value, const CameBy& /*run*/) { value[0] = value[1]; }
void magnitude(Words value, const CameBy& /*run*/) { value[0] = std::abs(value[0]); }
void z_of_direction(Words value, const CameBy& run) { value[0] = run.of(site::light_direction)[2]; }
void red_of_colour(Words value, const CameBy& run) { value[0] = first(run, site::light_colour); }
void unsigned_word(Words value, const CameBy& /*run*/) {
    if (value[0] < 0.0F)
        value[0] = static_cast<float>(double{value[0]} + 0x1p32);
}
void square_without_z(Words value, const CameBy& run) {
    const auto& q = run.of(site::to_light);
    value[0] = q[0] * q[0] + q[1] * q[1];
}
void rooted(Words value, const CameBy& /*run*/) { value[0] = std::sqrt(value[0]); }
void falloff_linear(Words value, const CameBy& run) { value[0] = 1.0F - std::sqrt(first(run, site::ratio)); }
void window_turned(Words value, const CameBy& run) { value[0] = first(run, site::ratio) * first(run, site::ratio); }
void share_of_range(Words value, const CameBy& run) {
    value[0] = first(run, site::squared) / first(run, site::range_before);
}
void distance_and_one(Words value, const CameBy& run) { value[0] = std::sqrt(first(run, site::squared)) + 1.0F; }
void fourth_power_and_one(Words value, const CameBy& run) {
    value[0] = first(run, site::squared) * first(run, site::squared) + 1.0F;
}
void averaged(Words value, const CameBy& /*run*/) {
    for (std::size_t c = 0; c < 3 && value[3] > 0.0F; ++c)
        value[c] /= value[3];
}
void of_length_one(Words value, const CameBy& /*run*/) {
    const float length = std::sqrt(value[0] * value[0] + value[1] * value[1] + value[2] * value[2]);
    for (std::size_t c = 0; c < 3 && length > 0.0F; ++c)
        value[c] /= length;
}
void units_cut(Words value, const CameBy& run) { value[0] = std::trunc(first(run, site::units)); }
void other_vector(Words value, const CameBy& /*run*/) {
    if (value[0] < 6.0F)
        value[0] += value[0] < 3.0F ? 3.0F : -3.0F;
}
/// Two channels for each other.
template <int low> void next_for_each_other(Words value, const CameBy& /*run*/) {
    if (value[0] == low || value[0] == low + 1)
        value[0] = 2 * low + 1 - value[0];
}
template <int low> void second_for_each_other(Words value, const CameBy& /*run*/) {
    if (value[0] == low || value[0] == low + 2)
        value[0] = 2 * low + 2 - value[0];
}
constexpr Formula green_for_blue = next_for_each_other<1>, y_for_z = next_for_each_other<4>,
                  red_for_blue = second_for_each_other<0>, x_for_z = second_for_each_other<3>;

/// Wherever lights are added up.
std::vector<NamedMistake> of_volumes() {
    static const Mistake z = spoiled_at(site::sum_z, magnitude);
    static const Mistake yz = with(spoiled_at(site::sum_y, magnitude), z);
    const Mistake magnitudes = with(spoiled_at(site::sum_x, magnitude), yz);
    std::vector<NamedMistake> all;
    for (const char* const pass : {"light_volume_scatter", "light_volume_gather", "light_volume_gather_direction",
                                   "light_volume_blend", "light_volume_blend_direction"}) {
        const auto add = [&](const char* name, const char* meaning, const Mistake& mistake) {
            all.push_back({name, meaning, pass, mistake});
        };
        add("direction_to_voxel", "the direction is from the light to the voxel",
            mistake_at(site::light_direction, Change::negated));
        add("corner_for_centre", "a voxel's point is its corner", mistake_at(site::offset, Change::zero));
        add("x_and_z_swapped", "a voxel's x is taken for its z", mistake_at(site::voxel_index, Change::xz_swapped));
        add("origin_ignored", "a voxel's point is taken from the world's origin, not the grid's",
            mistake_at(site::low, Change::zero));
        add("range_excluded", "at its very range a light does not reach",
            mistake_at(site::in_range, Change::or_equal, 0));
        add("range_not_squared", "the squared distance is compared with the range",
            mistake_at(site::range2, Change::instead, -1, &site::range_before));
        add("weights_not_added", "the sum of weights stays 0", mistake_at(site::sum_weight, Change::zero));
        add("z_not_added", "the sum of z stays 0", mistake_at(site::sum_z, Change::zero));
        add("range_ignored", "a light reaches beyond its range", mistake_at(site::in_range, Change::always));
        add("own_voxel_only", "a light reaches its own voxel alone", mistake_at(site::by_own_voxel, Change::always));
        add("falloff_not_squared", "the window is not squared", spoiled_at(site::attenuation, falloff_not_squared));
        add("distance_without_one", "the window is divided by s, not s + 1",
            mistake_at(site::denominator, Change::instead, -1, &site::squared));
        add("attenuation_without_distance", "the window is not divided by the distance",
            mistake_at(site::attenuation, Change::not_done));
        add("colour_not_attenuated", "a light's colour is added whole",
            mistake_at(site::light_colour, Change::instead, -1, &site::colour_before));
        add("direction_not_unit", "directions are as long as the vector to the light",
            mistake_at(site::unit, Change::instead, -1, &site::to_light));
        add("direction_by_square", "the vector to the light is divided by its squared length",
            mistake_at(site::distance, Change::not_done));
        add("direction_not_weighted", "directions are not weighted", mistake_at(site::weight, Change::one));
        add("direction_weighted_twice", "directions are weighted twice",
            mistake_at(site::light_direction, Change::times, -1, &site::attenuation));
        add("weight_is_one", "the sum of weights is a count", mistake_at(site::sum_weight, Change::one));
        add("point_guard_missing", "a light on the voxel's point has a direction",
            mistake_at(site::on_the_point, Change::never));
        add("never_counted", "lights are not counted", mistake_at(site::one_more, Change::zero));
        add("counted_twice", "each light is counted twice", mistake_at(site::one_more, Change::doubled));
        add("light_colour_red_is_green", "green is added to red", spoiled_at(site::light_colour, red_is_green));
        add("x_sum_of_z", "z is added to the sum of x", spoiled_at(site::sum_x, z_of_direction));
        add("weight_of_red", "red is added to the sum of weights", spoiled_at(site::sum_weight, red_of_colour));
        add("magnitudes_added", "negative numbers are added as positive ones", magnitudes);
        add("y_of_x", "a voxel's x is taken for its y", mistake_at(site::voxel_y, Change::instead, -1, &site::voxel_x));
        add("ball_cut_short", "voxels at the far side of a light's ball are left out", tried(WronglyTried::two_short));
        add("ball_begins_late", "voxels at the near side of a light's ball are left out",
            tried(WronglyTried::two_late));
        add("own_column_only", "of a light's ball only the voxels of its own x are tried",
            tried(WronglyTried::own_column));
        add("next_rows_only", "lights of cells more than one below are left out", tried(WronglyTried::next_rows));
        add("next_layers_only", "lights of cells more than one before are left out", tried(WronglyTried::next_layers));
        add("rounded_down", "addends are rounded down", mistake_at(site::half_unit, Change::zero));
        add("last_light_left_out", "the last light is left out", mistake_at(site::all_lights, Change::last_skipped));
        add("scale_doubled", "the scale of fixed point has a bit too many",
            mistake_at(site::fixed_scale, Change::doubled));
        add("scale_halved", "the scale of fixed point has a bit too few",
            mistake_at(site::fixed_scale, Change::halved));
        add("voxel_size_ignored", "every voxel is 1 m large", mistake_at(site::voxel_size, Change::one));
        add("far_corner_for_centre", "a voxel's point is its far corner", mistake_at(site::offset, Change::one));
        add("half_voxel_taken_away", "half a voxel is taken away from a voxel's corner, not added",
            mistake_at(site::offset, Change::negated));
        add("y_and_z_swapped", "a voxel's y is taken for its z", mistake_at(site::voxel_index, Change::yz_swapped));
        add("square_without_z", "squared distances leave z out", spoiled_at(site::squared, square_without_z));
        add("distance_for_square", "the distance is taken for its square", formula_at(site::squared, rooted));
        add("range_is_a_diameter", "a light reaches half of its range", mistake_at(site::range_before, Change::halved));
        add("falloff_by_share", "the window is of the squared share, not of its square",
            formula_at(site::falloff, falloff_by_share));
        add("falloff_linear", "the window is of the share of the range, not of its fourth power",
            formula_at(site::falloff, falloff_linear));
        add("window_missing", "light does not end at the range", mistake_at(site::falloff, Change::one));
        add("window_squared_twice", "the window is squared twice",
            mistake_at(site::falloff, Change::times, -1, &site::falloff));
        add("window_turned", "the window grows with the distance", spoiled_at(site::falloff, window_turned));
        add("share_of_range", "the squared distance is divided by the range, not by its square",
            formula_at(site::ratio, share_of_range));
        add("divided_by_fourth_power", "the window is divided by the distance's fourth power",
            formula_at(site::denominator, fourth_power_and_one));
        add("divided_by_distance", "the window is divided by the distance, not by its square",
            formula_at(site::denominator, distance_and_one));
        add("colour_attenuated_twice", "colours are weighted twice",
            mistake_at(site::light_colour, Change::times, -1, &site::attenuation));
        add("light_colour_turned", "red and blue of a light are swapped",
            mistake_at(site::colour_before, Change::xz_swapped));
        add("direction_of_motion", "a light's own way is added, not the way to it",
            mistake_at(site::unit, Change::instead, -1, &site::way));
        add("point_left_out", "a light on the voxel's point adds nothing",
            mistake_at(site::point_counts, Change::never));
        add("next_cells_only", "of a light only the next voxels are tried", tried(WronglyTried::next_cells));
        add("lower_half_only", "of a light's ball the upper half is not tried", tried(WronglyTried::lower_half));
        add("upper_half_only", "of a light's ball the lower half is not tried", tried(WronglyTried::upper_half));
        add("own_layer_only", "of a light's ball only the voxels of its own z are tried",
            tried(WronglyTried::own_layer));
    }
    return all;
}

/// Where floats are added in one order.
void add_sums(std::vector<NamedMistake>& all) {
    for (const char* const pass :
         {"light_volume_gather", "light_volume_gather_direction", "light_volume_blend", "light_volume_blend_direction"})
        all.push_back({"last_light_stays", "each light replaces the sum of those before it", pass,
                       mistake_at(site::adds, Change::never)});
    for (const char* const pass : {"light_volume_gather", "light_volume_blend"})
        all.push_back({"count_of_weights", "the count is the sum of weights", pass,
                       mistake_at(site::one_more, Change::instead, -1, &site::attenuation)});
    for (const char* const pass : {"light_volume_gather", "light_volume_gather_direction"}) {
        all.push_back({"greatest_light_alone", "of a voxel's lights the greatest value stays, not the sum", pass,
                       mistake_at(site::greatest, Change::always)});
        all.push_back({"rows_left_early", "of each row the lights behind one that does not reach are left out", pass,
                       mistake_at(site::goes_on, Change::never)});
        all.push_back({"stored_at_x_for_z", "a voxel's sums are stored with x and z swapped", pass,
                       mistake_at(site::own_place, Change::never)});
        all.push_back({"lights_not_by_cell", "places in the order by cells are taken for lights", pass,
                       mistake_at(site::by_cell, Change::never)});
        all.push_back({"last_cells_of_rows_left_out", "of each row the last cell's lights are left out", pass,
                       tried(WronglyTried::last_cells_of_rows)});
        all.push_back({"last_layer_of_cells_left_out", "lights of the last layer of cells are left out", pass,
                       tried(WronglyTried::last_layer_of_cells)});
        all.push_back({"textures_swapped", "each texture has the sums of the other", pass,
                       mistake_at(site::own_sums, Change::never)});
    }
    all.push_back({"sum_averaged", "sums are divided by the number of lights", "light_volume_gather",
                   formula_at(site::sum, averaged)});
    all.push_back({"sum_averaged", "sums are divided by the sum of weights", "light_volume_gather_direction",
                   formula_at(site::sum, averaged)});
    all.push_back({"directions_normalised", "the sum of directions is normalised before it is stored",
                   "light_volume_gather_direction", formula_at(site::sum, of_length_one)});
    for (const char* const pass : {"light_volume_gather", "light_volume_blend"})
        all.push_back({"green_and_blue_sums_swapped", "green and blue are added to each other's sums", pass,
                       mistake_at(site::light_colour, Change::yz_swapped)});
    for (const char* const pass : {"light_volume_gather_direction", "light_volume_blend_direction"})
        all.push_back({"x_and_z_sums_swapped", "x and z are added to each other's sums", pass,
                       mistake_at(site::light_direction, Change::xz_swapped)});
    for (const char* const pass : {"light_volume_gather_direction", "light_volume_blend_direction"})
        all.push_back({"y_and_z_sums_swapped", "y and z are added to each other's sums", pass,
                       mistake_at(site::light_direction, Change::yz_swapped)});
    for (const char* const pass : {"light_volume_gather", "light_volume_blend", "light_volume_resolve"})
        all.push_back(
            {"alpha_is_one", "alpha is 1, not the count", pass, mistake_at(site::volume_colour, Change::one, 3)});
    for (const char* const pass :
         {"light_volume_gather_direction", "light_volume_blend_direction", "light_volume_resolve_direction"})
        all.push_back({"alpha_is_one", "alpha is 1, not the sum of weights", pass,
                       mistake_at(site::volume_direction, Change::one, 3)});
}

/// Where they are added in words of the accumulator.
void add_words(std::vector<NamedMistake>& all) {
    const char* const clear = "light_volume_clear";
    const char* const scatter = "light_volume_scatter";
    static const Mistake points_from_world_origin = mistake_at(site::low, Change::zero);
    all.insert(
        all.end(),
        {{"clear_left_out", "the accumulator keeps what the frame before left", clear,
          mistake_at(site::is_cleared, Change::never)},
         {"cleared_to_one", "the accumulator starts from 1", clear, mistake_at(site::cleared, Change::one)},
         {"carries_lost", "carries between the words of a sum are lost", scatter,
          mistake_at(site::carries, Change::never)},
         {"carry_always", "a carry is added whether there is one or not", scatter,
          mistake_at(site::always_carries, Change::always)},
         {"borrows_lost", "the high word of a negative number is one too great", scatter,
          mistake_at(site::borrows, Change::never)},
         {"negatives_cut", "negative addends are rounded up, not down", scatter,
          mistake_at(site::rounds_down, Change::never)},
         {"negatives_cut", "negative addends are rounded up, not down", scatter, spoiled_at(site::quantum, units_cut)},
         {"origin_ignored", "a voxel's point is taken from the world's origin, not the grid's", scatter,
          with(tried(WronglyTried::from_world_origin), points_from_world_origin)},
         {"last_layer_left_out", "the last layer of voxels is left out", scatter, tried(WronglyTried::last_layer)},
         {"colours_for_directions", "colours and directions are added to each other's sums", scatter,
          spoiled_at(site::channel, other_vector)},
         {"y_and_z_sums_swapped", "y and z are added to each other's sums", scatter,
          spoiled_at(site::channel, y_for_z)},
         {"x_and_z_sums_swapped", "x and z are added to each other's sums", scatter,
          spoiled_at(site::channel, x_for_z)},
         {"green_and_blue_sums_swapped", "green and blue are added to each other's sums", scatter,
          spoiled_at(site::channel, green_for_blue)},
         {"channels_interleaved", "a voxel's channels lie beside each other, not a volume apart", scatter,
          mistake_at(site::is_stacked, Change::never)},
         {"count_of_weights", "the count is the sum of weights", "light_volume_resolve",
          mistake_at(site::count_word, Change::never)}});
    all.push_back({"sum_averaged", "sums are divided by the number of lights", "light_volume_resolve",
                   formula_at(site::volume_colour, averaged)});
    all.push_back({"sum_averaged", "sums are divided by the sum of weights", "light_volume_resolve_direction",
                   formula_at(site::volume_direction, averaged)});
    all.push_back({"directions_normalised", "the sum of directions is normalised before it is stored",
                   "light_volume_resolve_direction", formula_at(site::volume_direction, of_length_one)});
    for (const char* const pass : {"light_volume_resolve", "light_volume_resolve_direction"})
        all.insert(
            all.end(),
            {{"high_word_unsigned", "negative sums are read as great ones", pass,
              spoiled_at(site::high_word, unsigned_word)},
             {"low_word_lost", "sums are cut to whole numbers", pass, mistake_at(site::low_word, Change::zero)},
             {"words_swapped", "the two words of a sum are swapped", pass, mistake_at(site::low_first, Change::never)},
             {"low_word_rounded", "the low word is rounded to 24 bits, not cut", pass,
              mistake_at(site::low_is_cut, Change::never)},
             {"units_for_numbers", "sums are not divided by the scale of fixed point", pass,
              mistake_at(site::fixed_scale, Change::one)},
             {"channels_interleaved", "a voxel's channels are read beside each other", pass,
              mistake_at(site::is_stacked, Change::never)},
             {"y_and_z_sums_swapped", "the sums of y and z are read for each other", pass,
              spoiled_at(site::channel, y_for_z)},
             {"green_and_blue_sums_swapped", "the sums of green and blue are read for each other", pass,
              spoiled_at(site::channel, green_for_blue)},
             {"x_and_z_sums_swapped", "the sums of x and z are read for each other", pass,
              spoiled_at(site::channel, x_for_z)},
             {"red_and_blue_sums_swapped", "the sums of red and blue are read for each other", pass,
              spoiled_at(site::channel, red_for_blue)},
             {"scale_doubled", "the scale of fixed point has a bit too many", pass,
              mistake_at(site::fixed_scale, Change::halved)},
             {"scale_halved", "the scale of fixed point has a bit too few", pass,
              mistake_at(site::fixed_scale, Change::doubled)},
             {"textures_swapped", "each texture has the sums of the other", pass,
              mistake_at(site::own_sums, Change::never)}});
}

/// Where lights are sorted by cell.
void add_sorting(std::vector<NamedMistake>& all) {
    const auto sorted = [](CellBy by) { return Mistake{.change = Change::handed_over, .part = static_cast<int>(by)}; };
    all.insert(all.end(), {{"row_starts_late", "a row of cells begins behind its own lights", "light_sort_pass",
                            mistake_at(site::cell_start, Change::instead, -1, &site::row_end)},
                           {"cell_counts_twice", "each light of a cell is counted twice", "light_sort_pass",
                            mistake_at(site::cell_count, Change::doubled)}});
    all.insert(all.end(), {{"rows_by_y_first", "rows of cells are numbered along z, then along y", "light_sort_pass",
                            sorted(CellBy::y_first)},
                           {"cell_of_nearest_corner", "a light's cell is rounded, not cut", "light_sort_pass",
                            sorted(CellBy::nearest_corner)}});
}

} // namespace

std::vector<NamedMistake> volume_mistakes() {
    std::vector<NamedMistake> all = of_volumes();
    add_sums(all);
    add_words(all);
    add_sorting(all);
    return all;
}

} // namespace lockstep::lights
