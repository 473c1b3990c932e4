#include "crosscheck/lifecycle/mistakes.hpp"

#include <initializer_list>
#include <string>

#include "reference/lifecycle/sites.hpp"

namespace lockstep::lifecycle {
namespace {

/// The passes in which particles take a step.
constexpr std::initializer_list<const char*> simulating{"move", "move_particles", "simulate", "simulate_particles"};

std::vector<NamedMistake> made() {
    std::vector<NamedMistake> all;
    const auto in = [&](std::initializer_list<const char*> passes, const char* name, const char* meaning,
                        const Mistake& mistake) {
        for (const char* const pass : passes)
            all.push_back({name, meaning, pass, mistake});
    };
    using enum Change;
    // The step.
    in(simulating, "acceleration_missing", "nothing accelerates", mistake_at(site::force, zero));
    in(simulating, "acceleration_reversed", "acceleration has the wrong sign", mistake_at(site::force, negated));
    in(simulating, "acceleration_doubled", "acceleration counts twice", mistake_at(site::force, doubled));
    in(simulating, "position_before_velocity", "the old velocity moves the particle",
       mistake_at(site::moving_velocity, instead, -1, &site::velocity_before));
    in(simulating, "not_moved", "the velocity moves nothing", mistake_at(site::way, zero));
    in(simulating, "moved_twice", "the way counts twice", mistake_at(site::way, doubled));
    in(simulating, "velocity_kept", "the velocity is stored as it was",
       mistake_at(site::velocity, instead, -1, &site::velocity_before));
    in(simulating, "never_ages", "nobody ages", mistake_at(site::aged, zero));
    in(simulating, "ages_twice", "a tick counts twice", mistake_at(site::aged, doubled));
    in(simulating, "grows_younger", "time is added", mistake_at(site::aged, negated));
    in(simulating, "drag_missing", "nothing brakes", mistake_at(site::drag_factor, zero));
    in(simulating, "drag_factor_missing", "nothing brakes", mistake_at(site::braked, instead, -1, &site::faster));
    in(simulating, "drag_reversed", "drag pushes along", mistake_at(site::drag, negated));
    // Forces.
    in(simulating, "vortex_reversed", "the vortex turns the other way", mistake_at(site::swirl, negated));
    in(simulating, "vortex_missing", "the vortex does not turn", mistake_at(site::swirl, zero));
    in(simulating, "vortex_pushes", "the vortex blows outwards", mistake_at(site::sink, negated));
    in(simulating, "vortex_without_pull", "the vortex does not pull", mistake_at(site::sink, zero));
    in(simulating, "repels", "the point pushes away", mistake_at(site::attraction, negated));
    in(simulating, "attraction_missing", "the point does not attract", mistake_at(site::attraction, zero));
    in(simulating, "falloff_missing", "a force is as strong at its rim", mistake_at(site::left_of_force, one));
    in(simulating, "axis_part_kept", "the way from the axis is that from the centre",
       mistake_at(site::across, instead, -1, &site::to_centre));
    in(simulating, "softening_missing", "the point is not softened", mistake_at(site::softening, zero));
    in(simulating, "kills_nobody", "the kill radius is not looked at", mistake_at(site::is_killed, never));
    in(simulating, "kills_everybody", "everyone is killed", mistake_at(site::is_killed, always));
    in(simulating, "curl_reversed", "the noise blows the other way", mistake_at(site::curl, negated));
    in(simulating, "curl_missing", "the noise does not blow", mistake_at(site::curl, zero));
    in(simulating, "noise_not_panned", "the noise stands still", mistake_at(site::offset, zero));
    in(simulating, "frequency_missing", "the noise has the frequency 1", mistake_at(site::frequency, one));
    // The order.
    in({"move", "move_particles"}, "rest_moved_by_one", "who cannot die comes from one slot on",
       mistake_at(site::source, one_more));
    in({"move", "move_particles"}, "rest_moved_from_one_before", "everyone comes from one slot before",
       mistake_at(site::source, one_less));
    in({"move", "move_particles"}, "source_doubled", "the slot of the source counts twice",
       mistake_at(site::source, doubled));
    in({"move", "move_particles"}, "survivors_forgotten", "the survivors are not moved",
       mistake_at(site::survivors_before, zero));
    in({"destroy"}, "rank_inclusive", "the list holds the next slot", mistake_at(site::rank, one_more));
    in({"destroy_reduce", "destroy", "destroy_count"}, "all_survive", "nobody dies",
       mistake_at(site::survives, always));
    in({"destroy_reduce", "destroy", "destroy_count"}, "none_survives", "all that may die do",
       mistake_at(site::survives, never));
    in({"destroy_reduce", "destroy", "destroy_count"}, "dead_at_below_zero", "who has exactly 0 left survives",
       mistake_at(site::survives, or_equal));
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
    in({"emit"}, "jitter_missing", "all start in one direction", mistake_at(site::jitter, zero));
    in({"emit"}, "speed_not_varied", "all start at one speed", mistake_at(site::speed_jitter, zero));
    in({"emit"}, "serial_one_more", "newborns have the random numbers of the next", mistake_at(site::serial, one_more));
    in({"emit"}, "channel_one_more", "random numbers come from the next channel", mistake_at(site::channel, one_more));
    in({"emit"}, "random_reversed", "random numbers fall where they should rise", mistake_at(site::random, opposite));
    in({"emit"}, "size_not_given", "newborns have no size", mistake_at(site::initial_size, zero));
    in({"emit", "emit_counters"}, "emitted_none", "nobody is born", mistake_at(site::request, zero));
    in({"emit", "emit_counters"}, "emitted_one_more", "one more is born", mistake_at(site::request, one_more));
    in({"emit", "emit_counters"}, "request_not_clamped", "more are born than fit", mistake_at(site::fits, always));
    // Counters and calls.
    in({"post_destroy"}, "died_not_counted", "nobody is counted as dead", mistake_at(site::died, zero));
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
    in({"indirect"}, "nobody_may_die", "nobody may die", mistake_at(site::may_die, zero));
    in({"indirect"}, "everybody_may_die", "everyone may die", mistake_at(site::may_die, instead, -1, &site::alive));
    in({"indirect_arguments"}, "draws_one_more", "one too many is drawn", mistake_at(site::alive_before, one_more));
    in({"indirect_arguments"}, "draws_nobody", "nobody is drawn", mistake_at(site::draw_sprite, zero));
    in({"indirect_arguments"}, "groups_rounded_down", "the last group to destroy is missing",
       mistake_at(site::destroy_groups, one_less));
    in({"indirect_arguments"}, "move_groups_rounded_down", "the last group to move is missing",
       mistake_at(site::move_groups, one_less));
    in({"post_destroy_arguments"}, "simulate_groups_rounded_down", "the last group to simulate is missing",
       mistake_at(site::simulate_groups, one_less));
    // Ribbons.
    in({"ribbon_distance"}, "distance_missing", "points have no distance", mistake_at(site::way_to_point, zero));
    in({"ribbon_distance"}, "distance_squared", "the distance is squared", mistake_at(site::way_to_point, squared));
    in({"ribbon"}, "tangent_one_sided", "the tangent is that of the segment behind",
       mistake_at(site::tangent, instead, -1, &site::segment_after));
    in({"ribbon"}, "mitre_missing", "corners are not mitred", mistake_at(site::is_mitred, never));
    in({"ribbon"}, "width_doubled", "the ribbon is twice as wide", mistake_at(site::half_width, doubled));
    in({"ribbon"}, "side_flipped", "left is right", mistake_at(site::side_of_ribbon, negated));
    in({"ribbon"}, "uv_scale_missing", "u is not scaled", mistake_at(site::uv_scale, one));
    in({"post_destroy"}, "uv_jump", "the length of the dead is lost", mistake_at(site::way_of_dead, zero));
    return all;
}

} // namespace

const std::vector<NamedMistake>& mistakes() {
    static const std::vector<NamedMistake> all = made();
    return all;
}

} // namespace lockstep::lifecycle
