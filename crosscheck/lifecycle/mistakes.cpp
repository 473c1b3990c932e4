#include "crosscheck/lifecycle/mistakes.hpp"

#include <cmath>
#include <initializer_list>
#include <span>
#include <string>

#include "crosscheck/judge/mistake_words.hpp"
#include "reference/lifecycle/packing.hpp"

#include "reference/lifecycle/draw_sites.hpp"

namespace lockstep::lifecycle {
namespace {

/// The passes in which particles take a step.
constexpr std::initializer_list<const char*> simulating{"move", "move_particles", "simulate", "simulate_particles"};

/// The passes in which numbers become halves.
constexpr std::initializer_list<const char*> packing{
    "emit", "move", "move_particles", "simulate", "simulate_particles", "ribbon_distance", "prefix_sum_particles"};

template <HalfRounding rounding> void rounded(std::span<float> code, const CameBy& run) {
    code[0] = ordered_half(half_code(run.of(site::half_source)[0], rounding));
}

std::uint32_t magnitude_of(float x) { return std::bit_cast<std::uint32_t>(x) & 0x7fffffffU; }

/// With another code, of a number that is no subnormal half.
void set_code(std::span<float> code, float of, std::uint32_t magnitude) {
    if (magnitude_of(of) >= 0x38800000U && magnitude_of(of) < 0x7f800000U)
        code[0] = ordered_half((std::signbit(of) ? 0x8000U : 0U) | std::min(magnitude, 0x7bffU));
}

void rounded_half_up(std::span<float> code, const CameBy& run) {
    const float x = run.of(site::half_source)[0];
    set_code(code, x, (magnitude_of(x) - 0x38000000U + 0x1000U) >> 13U);
}

void exponent_one_more(std::span<float> code, const CameBy& run) {
    set_code(code, run.of(site::half_source)[0], (half_of_ordered(static_cast<int>(code[0])) & 0x7fffU) + 0x400U);
}

void without_sign(std::span<float> code, const CameBy& /*run*/) {
    if (code[0] < 0.0F)
        code[0] = -1.0F - code[0];
}

void read_exponent_one_less(std::span<float> value, const CameBy& /*run*/) {
    if (std::abs(value[0]) >= 0x1p-14F)
        value[0] *= 0.5F;
}

void of_23_bits(std::span<float> value, const CameBy& /*run*/) {
    for (float& x : value)
        x = std::floor(x * 0x1p23F) * 0x1p-24F;
}

void premultiplied(std::span<float> tint, const CameBy& /*run*/) {
    for (std::size_t c = 0; c < 3; ++c)
        tint[c] *= tint[3];
}

/// Drag brakes the old velocity alone, not what accelerated it.
void braked_before(std::span<float> value, const CameBy& run) {
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = run.of(site::velocity_before)[c] * run.of(site::drag_factor)[0] +
                   run.of(site::force)[c] * run.of(site::tick)[0];
}

/// One component of a place in a box drawn as another is.
template <std::size_t component, std::size_t as> void drawn_as(std::span<float> value, const CameBy& run) {
    value[component] =
        run.of(site::shape_low)[component] + run.of(site::random)[as] * run.of(site::shape_size)[component];
}

/// Of whole ticks.
void last_tick_lost(std::span<float> left, const CameBy& /*run*/) {
    if (left[0] == 1.0F)
        left[0] = 0.0F;
}

const Mistake end_red_for_blue = mistake_at(site::end_color, Change::xz_swapped);
const Mistake end_green_for_blue = mistake_at(site::end_color, Change::yz_swapped);
const Mistake first_opacity_again = mistake_at(site::end_opacity, Change::instead, -1, &site::initial_opacity);

std::vector<NamedMistake> made() {
    std::vector<NamedMistake> all;
    const auto in = [&](std::initializer_list<const char*> passes, const char* name, const char* meaning,
                        const Mistake& mistake) {
        for (const char* const pass : passes)
            all.push_back({name, meaning, pass, mistake});
    };
    using enum Change;
    using enum HalfRounding;
    // The step.
    in(simulating, "acceleration_missing", "nothing accelerates", mistake_at(site::force, zero));
    in(simulating, "acceleration_reversed", "acceleration has the wrong sign", mistake_at(site::force, negated));
    in(simulating, "acceleration_doubled", "acceleration counts twice", mistake_at(site::force, doubled));
    in(simulating, "position_before_velocity", "the old velocity moves the particle",
       mistake_at(site::moving_velocity, instead, -1, &site::velocity_before));
    in(simulating, "not_moved", "the velocity moves nothing", mistake_at(site::way, zero));
    in(simulating, "moved_twice", "the step counts twice", mistake_at(site::way, doubled));
    in(simulating, "velocity_kept", "the velocity is stored as it was",
       mistake_at(site::velocity, instead, -1, &site::velocity_before));
    in(simulating, "never_ages", "no particle ages", mistake_at(site::aged, zero));
    in(simulating, "ages_twice", "a tick counts twice", mistake_at(site::aged, doubled));
    in(simulating, "grows_younger", "time is added", mistake_at(site::aged, negated));
    in(simulating, "last_tick_lost", "a particle with one tick left has none",
       spoiled_at(site::remaining, last_tick_lost));
    in(simulating, "drag_missing", "no drag brakes", mistake_at(site::drag_coefficient, zero));
    in(simulating, "stopped_by_drag", "drag leaves nothing of the velocity", mistake_at(site::drag_factor, zero));
    in(simulating, "drag_factor_missing", "nothing brakes", mistake_at(site::braked, instead, -1, &site::faster));
    in(simulating, "drag_before_acceleration", "drag brakes the old velocity, not what a tick makes of it",
       spoiled_at(site::braked, braked_before));
    in({"emit"}, "box_y_as_x", "y in a box is drawn as x is", spoiled_at(site::shape_place, drawn_as<1, 0>));
    in({"emit"}, "box_z_as_x", "z in a box is drawn as x is", spoiled_at(site::shape_place, drawn_as<2, 0>));
    in({"emit"}, "box_z_as_y", "z in a box is drawn as y is", spoiled_at(site::shape_place, drawn_as<2, 1>));
    in(simulating, "drag_reversed", "drag pushes particles on", mistake_at(site::drag, negated));
    // Forces.
    in(simulating, "vortex_reversed", "the vortex turns the other way", mistake_at(site::swirl, negated));
    in(simulating, "vortex_missing", "the vortex does not turn", mistake_at(site::swirl, zero));
    in(simulating, "vortex_pushes", "the vortex blows outwards", mistake_at(site::sink, negated));
    in(simulating, "vortex_without_pull", "the vortex does not pull", mistake_at(site::sink, zero));
    in(simulating, "repels", "the point pushes away", mistake_at(site::attraction, negated));
    in(simulating, "attraction_missing", "the point does not attract", mistake_at(site::attraction, zero));
    in(simulating, "falloff_missing", "a force is as strong at its rim", mistake_at(site::left_of_force, one));
    in(simulating, "axis_part_kept", "the vector from the axis is that from the centre",
       mistake_at(site::across, instead, -1, &site::to_centre));
    in(simulating, "softening_missing", "the point is not softened", mistake_at(site::softening, zero));
    in(simulating, "kills_nobody", "the kill radius is not looked at", mistake_at(site::is_killed, never));
    in(simulating, "kills_everybody", "every particle is killed", mistake_at(site::is_killed, always));
    in(simulating, "curl_reversed", "the noise blows the other way", mistake_at(site::curl, negated));
    in(simulating, "curl_missing", "the noise does not blow", mistake_at(site::curl, zero));
    in(simulating, "noise_not_panned", "the noise stands still", mistake_at(site::offset, zero));
    in(simulating, "frequency_missing", "the noise has the frequency 1", mistake_at(site::frequency, one));
    // The order.
    in({"move", "move_particles"}, "rest_moved_by_one",
       "particles that cannot die are copied from the slot after theirs", mistake_at(site::source, one_more));
    in({"move", "move_particles"}, "rest_moved_from_one_before",
       "every particle is copied from the slot before its own", mistake_at(site::source, one_less));
    in({"move", "move_particles"}, "source_doubled", "the slot of the source counts twice",
       mistake_at(site::source, doubled));
    in({"move", "move_particles"}, "survivors_forgotten", "the survivors are not moved",
       mistake_at(site::survivors_before, zero));
    in({"destroy"}, "rank_inclusive", "the list holds the next slot", mistake_at(site::rank, one_more));
    in({"destroy_reduce", "destroy", "destroy_count"}, "all_survive", "no particle dies",
       mistake_at(site::survives, always));
    in({"destroy_reduce", "destroy", "destroy_count"}, "none_survives", "all that may die do",
       mistake_at(site::survives, never));
    in({"destroy_reduce", "destroy", "destroy_count"}, "dead_at_below_zero", "a particle with exactly 0 left survives",
       mistake_at(site::survives, or_equal, 0));
    in({"move", "move_particles"}, "rest_by_one",
       "particles that cannot die are copied from the slot after theirs, the survivors from their own",
       mistake_at(site::rest, one_more));
    in({"destroy"}, "listed_one_place_on", "the list begins one place later", mistake_at(site::list_place, one_less));
    // Lists.
    in({"emit_list"}, "newborns_not_listed", "the newborns are in no list", mistake_at(site::is_new, never));
    in({"post_destroy"}, "lists_not_swapped", "the list that was made is not the next frame's",
       mistake_at(site::current_list, opposite));
    in({"destroy_dead"}, "dead_not_listed", "the slots of the dead are lost", mistake_at(site::is_dead, never));
    in({"destroy_dead"}, "dead_one_place_on", "the dead are listed one place later",
       mistake_at(site::dead_rank, one_less));
    in({"simulate", "simulate_particles"}, "newborns_not_simulated", "the newborns take no step",
       mistake_at(site::particles_present, instead, -1, &site::alive_before));
    in({"sort"}, "order_not_compared", "within a frame the slot goes before the order",
       mistake_at(site::key_order_compared, zero));
    in({"sort"}, "time_not_compared", "the order in the frame goes before the time",
       mistake_at(site::key_time_compared, zero));
    in({"sort"}, "sorted_falling", "the youngest come first", mistake_at(site::sorts_before, inverted));
    in({"sort"}, "all_runs_rise", "no run falls", mistake_at(site::is_rising, always));
    in({"pre_sort"}, "one_too_few_padded", "a key of the dead is among those of the living",
       mistake_at(site::alive_before, one_more));
    // Packing.
    in(packing, "halves_truncated", "halves are rounded toward zero", spoiled_at(site::half, rounded<toward_zero>));
    in(packing, "halves_to_nearest", "halves are rounded to the nearest, as drivers do",
       spoiled_at(site::half, rounded<nearest_even>));
    in(packing, "halves_half_up", "ties go away from zero", spoiled_at(site::half, rounded_half_up));
    in(packing, "half_exponent_off", "the exponent of a half is one more", spoiled_at(site::half, exponent_one_more));
    in(packing, "half_sign_lost", "halves have no sign", spoiled_at(site::half, without_sign));
    in(packing, "half_read_off", "the exponent of a half is read one less",
       spoiled_at(site::half_read, read_exponent_one_less));
    in({"emit"}, "colors_truncated", "colours are cut off", mistake_at(site::half_step, zero));
    in({"emit"}, "colors_by_256", "1 is beyond the greatest code", mistake_at(site::color_steps, one_more));
    // Emission.
    in({"emit"}, "born_still", "newborns do not move", mistake_at(site::velocity, zero));
    in({"emit"}, "born_backwards", "newborns move the other way", mistake_at(site::velocity, negated));
    in({"emit"}, "born_at_origin", "newborns are born at 0", mistake_at(site::position, zero));
    in({"emit"}, "emitter_not_followed", "newborns are born where the emitter was not", mistake_at(site::origin, zero));
    in({"emit"}, "acceleration_not_given", "newborns get no acceleration", mistake_at(site::acceleration, zero));
    in({"emit"}, "shortest_life", "all live the shortest lifetime",
       mistake_at(site::share_of_life, instead, -1, &site::shortest));
    in({"emit"}, "spawn_time_missing", "newborns were born at 0", mistake_at(site::time, zero));
    in({"emit"}, "colors_swapped", "red and blue are swapped", mistake_at(site::initial_color, xz_swapped));
    in({"emit"}, "end_colors_swapped", "red and blue of the last colour are swapped",
       mistake_at(site::end_color, xz_swapped));
    Mistake channels = mistake_at(site::initial_color, xz_swapped);
    channels.also = &end_red_for_blue;
    in({"emit"}, "red_for_blue", "red and blue of both colours are swapped", channels);
    channels = mistake_at(site::initial_color, yz_swapped);
    channels.also = &end_green_for_blue;
    in({"emit"}, "green_for_blue", "green and blue of both colours are swapped", channels);
    in({"emit"}, "jitter_missing", "all start in one direction", mistake_at(site::jitter, zero));
    in({"emit"}, "speed_not_varied", "all start at one speed", mistake_at(site::speed_jitter, zero));
    in({"emit"}, "serial_one_more", "newborns have the random numbers of the next", mistake_at(site::serial, one_more));
    in({"emit"}, "channel_one_more", "random numbers come from the next channel", mistake_at(site::channel, one_more));
    in({"emit"}, "random_reversed", "random numbers fall where they should rise", mistake_at(site::random, opposite));
    in({"emit"}, "random_of_23_bits", "a bit of the random numbers is lost", spoiled_at(site::random, of_23_bits));
    in({"emit"}, "life_by_x", "the lifetime goes by the random number of the speed",
       mistake_at(site::random_of_life, x_everywhere));
    in({"emit"}, "life_by_another_channel", "the lifetime goes by the channel of the direction",
       mistake_at(site::channel_of_life, one_less));
    in({"emit"}, "sizes_swapped", "the first size is the last", mistake_at(site::sizes, swapped));
    Mistake end_color = mistake_at(site::end_color, instead, -1, &site::initial_color);
    end_color.also = &first_opacity_again;
    in({"emit"}, "end_color_missing", "the last colour is the first", end_color);
    in({"emit_arguments"}, "moved_without_newborns", "the newborns have no groups to be moved",
       mistake_at(site::present, instead, -1, &site::alive_before));
    in({"emit"}, "size_not_given", "newborns have no size", mistake_at(site::initial_size, zero));
    in({"emit", "emit_counters"}, "emitted_none", "no particle is born", mistake_at(site::request, zero));
    in({"emit", "emit_counters"}, "emitted_one_more", "one more is born", mistake_at(site::request, one_more));
    in({"emit", "emit_counters"}, "request_not_clamped", "more are born than fit", mistake_at(site::fits, always));
    // Counters and calls.
    in({"post_destroy"}, "died_not_counted", "no particle is counted as dead", mistake_at(site::died, zero));
    in({"post_destroy"}, "alive_kept", "the number of the living stays",
       mistake_at(site::alive, instead, -1, &site::alive_before));
    in({"post_destroy"}, "alive_is_survivors", "the living are the survivors alone",
       mistake_at(site::alive, instead, -1, &site::survivors_before));
    in({"post_destroy"}, "alive_one_more", "one too many is alive", mistake_at(site::alive, one_more));
    in({"post_emit"}, "newborns_not_counted", "the newborns are not counted",
       mistake_at(site::alive, instead, -1, &site::alive_before));
    in({"post_destroy", "post_emit"}, "serial_not_counted", "serials are given again",
       mistake_at(site::serial_count, zero));
    in({"post_destroy", "post_emit"}, "drops_not_counted", "what does not fit is not counted",
       mistake_at(site::dropped_total, zero));
    in({"post_destroy", "post_emit"}, "ring_not_left", "emissions never leave the ring",
       mistake_at(site::leaving, zero));
    in({"post_destroy", "post_emit"}, "ring_not_advanced", "the ring does not advance",
       mistake_at(site::ring_head, zero));
    in({"post_destroy_ring", "post_emit_ring"}, "ring_not_filled", "the emission is not written into the ring",
       mistake_at(site::ring, zero));
    in({"indirect"}, "may_die_one_more", "one too many may die", mistake_at(site::may_die, one_more));
    in({"indirect"}, "may_die_one_less", "one too few may die", mistake_at(site::may_die, one_less));
    in({"indirect"}, "nobody_may_die", "no particle may die", mistake_at(site::may_die, zero));
    in({"indirect"}, "everybody_may_die", "every particle may die",
       mistake_at(site::may_die, instead, -1, &site::alive_before));
    in({"indirect_arguments"}, "draws_one_more", "one too many is drawn", mistake_at(site::alive_before, one_more));
    in({"indirect_arguments"}, "draws_nobody", "no particle is drawn", mistake_at(site::draw_sprite, zero));
    in({"indirect_arguments"}, "groups_rounded_down", "the last group to destroy is missing",
       mistake_at(site::destroy_groups, one_less));
    in({"indirect_arguments"}, "move_groups_rounded_down", "the last group to move is missing",
       mistake_at(site::move_groups, one_less));
    in({"post_destroy_arguments"}, "simulate_groups_rounded_down", "the last group to simulate is missing",
       mistake_at(site::simulate_groups, one_less));
    // Ribbons.
    in({"ribbon_distance"}, "distance_missing", "points have no distance", mistake_at(site::way_to_point, zero));
    in({"ribbon_distance"}, "distance_squared", "the distance is squared", mistake_at(site::way_to_point, squared));
    in({"ribbon"}, "tangent_reversed", "the tangent points back along the ribbon",
       mistake_at(site::tangent, Change::negated));
    in({"ribbon"}, "segment_after_reversed", "the segment to the next point is taken from it",
       mistake_at(site::segment_after, Change::negated));
    in({"ribbon"}, "tangent_one_sided", "the tangent is that of the segment behind",
       mistake_at(site::tangent, instead, -1, &site::segment_after));
    in({"ribbon"}, "mitre_missing", "corners are not mitred", mistake_at(site::is_mitred, never));
    in({"ribbon"}, "width_doubled", "the ribbon is twice as wide", mistake_at(site::half_width, doubled));
    in({"ribbon"}, "side_flipped", "left is right", mistake_at(site::half_width, negated));
    in({"ribbon"}, "uv_scale_missing", "u is not scaled", mistake_at(site::uv_scale, one));
    // Drawing.
    in({"draw"}, "size_not_halved", "sprites are twice as large", mistake_at(site::half_width, doubled));
    in({"draw"}, "size_missing", "sprites have no size", mistake_at(site::half_width, zero));
    in({"draw"}, "age_reversed", "the last look is that of birth", mistake_at(site::age, opposite));
    in({"draw"}, "never_changes", "sprites look as at birth", mistake_at(site::age, zero));
    in({"draw"}, "expired_drawn", "a particle with no time left is drawn", mistake_at(site::is_visible, always));
    in({"draw"}, "looks_as_at_death", "sprites look as at their end", mistake_at(site::age, one));
    in({"draw"}, "sprite_upside_down", "a sprite's top is its bottom", mistake_at(site::way_to_corner, negated, 1));
    in({"draw"}, "sprite_mirrored", "a sprite's left is its right", mistake_at(site::way_to_corner, negated, 0));
    in({"draw"}, "u_for_v", "u and v are swapped at the corners", mistake_at(site::way_to_corner, swapped));
    in({"draw"}, "tint_premultiplied", "the tint is multiplied by its opacity", spoiled_at(site::tint, premultiplied));
    in({"draw"}, "picture_upside_down", "up is down", mistake_at(site::clip, negated, 1));
    in({"draw"}, "picture_mirrored", "left is right", mistake_at(site::clip, negated, 0));
    in({"draw"}, "colors_swapped", "red and blue are swapped", mistake_at(site::tint, xz_swapped));
    in({"post_destroy"}, "uv_jump", "the length of the dead is lost", mistake_at(site::way_of_dead, zero));
    return all;
}

} // namespace

const std::vector<NamedMistake>& mistakes() {
    static const std::vector<NamedMistake> all = made();
    return all;
}

} // namespace lockstep::lifecycle
