#include "reference/collision/formulas/words.hpp"

#include <deque>
#include <string_view>

#include "reference/collision/formulas/fits.hpp"
#include "reference/half.hpp"

namespace lockstep::formulas {
namespace {

constexpr std::array lengths{1e-1F, 1e-2F, 1e-3F, 1e-4F, 1e-5F, 1e-6F, 1e-7F, 1e-8F};
constexpr std::array rates{0.01F, 0.02F, 0.05F, 0.1F, 0.2F, 0.25F, 0.3F, 0.5F, 0.75F, 1.0F, 2.0F, 5.0F};
constexpr std::array ticks{1.0F / 120.0F, 1.0F / 60.0F, 0.016F, 0.0166F, 0.0167F, 0.01667F,
                           1.0F / 30.0F,  0.01F,        0.02F,  0.033F,  0.1F};
constexpr std::array drags{0.5F, 0.8F, 0.9F, 0.95F, 0.98F, 0.99F, 0.995F, 0.999F, 0.9999F, 1.001F, 1.01F, 1.05F, 1.1F};

template <int axis, bool floor> Mistake plane() {
    static constexpr Formula keep_off = [](Floats v, Run run) {
        v[axis] = floor ? std::max(v[axis], run.constants[0]) : std::min(v[axis], run.constants[0]);
    };
    static const Mistake too = value(site::position_at_hit, keep_off);
    return value(site::position, keep_off, &too);
}

/// Who stays as it is instead of falling, with its collide time or without.
template <class Rests> void rests(std::vector<FormulaMistake>& all, std::string_view name, std::string_view meaning,
                                  std::string_view name_if_counted, std::string_view meaning_if_counted, Rests) {
    static const Mistake position = value(site::position, [](Floats v, Run run) {
        if (Rests()(run))
            set(v, before(run));
    });
    static const Mistake speed = value(
        site::speed,
        [](Floats v, Run run) {
            if (Rests()(run))
                v[0] = real(run, site::speed_before);
        },
        &position);
    static const Mistake direction = value(
        site::direction,
        [](Floats v, Run run) {
            if (Rests()(run))
                set(v, old_direction(run));
        },
        &speed);
    static const Formula count = [](Floats v, Run run) {
        if (Rests()(run))
            v[0] = real(run, site::collide_time_before);
    };
    all.push_back({name, meaning, value(site::collide_time, count, &direction)});
    all.push_back({name_if_counted, meaning_if_counted, direction});
}

} // namespace

void add_fall(std::vector<FormulaMistake>& all) {
    all.push_back({"moves_by_mean_velocity", "no hit: moves by the mean of old and new velocity",
                   value(site::step, [](Floats v, Run run) {
                       set(v, 0.5F * (vec3(run, site::velocity_before) + vec3(run, site::velocity)));
                   })});
    all.push_back({"moves_by_speed_before", "no hit: moves along the new direction by the old speed",
                   value(site::step, [](Floats v, Run run) {
                       set(v, vec3(run, site::direction) * real(run, site::speed_before));
                   })});
    static const auto half_gt2 = [](Run run) { return 0.5F * tick(run) * fall(run); };
    all.push_back({"half_gt2_added", "no hit: half g t^2 is added to the move by the new velocity",
                   value(site::position, [](Floats v, Run run) { set(v, get(v) + half_gt2(run)); })});
    all.push_back({"half_gt2_without_half", "no hit: g t^2 is added to the move by the new velocity",
                   value(site::position, [](Floats v, Run run) { set(v, get(v) + 2.0F * half_gt2(run)); })});
    static const Mistake squared_at_hit = hit_position([](Floats v, Run run) {
        const float t = tick(run);
        set(v, before(run) + vec3(run, site::moves_along) * real(run, site::moves_by) * (t * t));
    });
    static const Formula by_tick_twice = [](Floats v, Run run) { set(v, get(v) * tick(run)); };
    all.push_back(
        {"tick_squared", "moves by dir * speed * tick * tick", value(site::move, by_tick_twice, &squared_at_hit)});
    all.push_back(
        {"tick_squared_in_fall", "no hit: moves by dir * speed * tick * tick", value(site::move, by_tick_twice)});
    const auto turned = [&](std::string_view name, std::string_view meaning, Change change) {
        all.push_back({name, meaning, {.site = site::fall.id, .change = change}});
    };
    turned("gravity_x_and_y_swapped", "x and y of gravity are swapped", Change::swapped);
    turned("gravity_y_and_z_swapped", "y and z of gravity are swapped", Change::yz_swapped);
    turned("gravity_x_and_z_swapped", "x and z of gravity are swapped", Change::xz_swapped);
    turned("gravity_rotated", "gravity.yzx for gravity", Change::rotated);
    turned("gravity_rotated_back", "gravity.zxy for gravity", Change::rotated_back);
    all.push_back({"gravity_is_a_constant",
                   "a constant for u_Gravity",
                   value(site::fall,
                         [](Floats v, Run run) {
                             for (std::size_t c = 0; c < 3; ++c)
                                 v[c] = run.constants[c] * tick(run);
                         }),
                   {},
                   gravity_of});
    all.push_back(
        {"gravity_in_y_alone", "only gravity's y acts", value(site::fall, [](Floats v, Run) { v[0] = v[2] = 0.0F; })});
    all.push_back({"gravity_straight_down", "gravity's length acts along -y", value(site::fall, [](Floats v, Run) {
                       set(v, {0.0F, -glm::length(get(v)), 0.0F});
                   })});
    all.push_back({"gravity_waits_for_collide_time", "no gravity while the collide time is above 0",
                   value(site::fall, [](Floats v, Run run) {
                       if (real(run, site::collide_time_before) > 0.0F)
                           set(v, glm::vec3(0.0F));
                   })});
    all.push_back({"gravity_waits_for_search", "no gravity while the collide time is 0 or above",
                   value(site::fall, [](Floats v, Run run) {
                       if (real(run, site::collide_time_before) >= 0.0F)
                           set(v, glm::vec3(0.0F));
                   })});
    all.push_back({"gravity_only_after_hits", "gravity acts only while the collide time is above 0",
                   value(site::fall, [](Floats v, Run run) {
                       if (!(real(run, site::collide_time_before) > 0.0F))
                           set(v, glm::vec3(0.0F));
                   })});
    all.push_back({"gravity_added_to_direction", "no hit: (direction + gravity * tick) * speed",
                   value(site::velocity, [](Floats v, Run run) {
                       set(v, (old_direction(run) + fall(run)) * real(run, site::speed_before));
                   })});
    all.push_back({"gravity_by_tick_twice", "gravity * tick * tick",
                   value(site::fall, [](Floats v, Run run) { set(v, get(v) * tick(run)); })});
    all.push_back({"drag_in_fall", "no hit: the speed is multiplied by a constant",
                   value(site::speed, [](Floats v, Run run) { v[0] *= run.constants[0]; }), drags});
    static const Mistake moves_by_velocity =
        value(site::step, [](Floats v, Run run) { set(v, vec3(run, site::velocity)); });
    all.push_back({"drag_in_stored_speed", "no hit: the stored speed is multiplied by a constant, the step is not",
                   value(
                       site::speed, [](Floats v, Run run) { v[0] *= run.constants[0]; }, &moves_by_velocity),
                   drags});
    all.push_back({"factor_in_fall", "no hit: the speed is multiplied by u_SpeedFactor",
                   value(site::speed, [](Floats v, Run run) { v[0] *= params(run).switches.speed_factor; })});
    all.push_back({"speed_capped",
                   "no hit: the speed is at most a constant",
                   value(site::speed, [](Floats v, Run run) { v[0] = std::min(v[0], run.constants[0]); }),
                   {},
                   speed_of});
    all.push_back({"speed_at_least",
                   "no hit: the speed is at least a constant",
                   value(site::speed, [](Floats v, Run run) { v[0] = std::max(v[0], run.constants[0]); }),
                   {},
                   speed_of});
    all.push_back(
        {"stored_speed_capped",
         "no hit: the stored speed is at most a constant, the step is not",
         value(
             site::speed, [](Floats v, Run run) { v[0] = std::min(v[0], run.constants[0]); }, &moves_by_velocity),
         {},
         speed_of});
    all.push_back(
        {"stored_speed_at_least",
         "no hit: the stored speed is at least a constant, the step is not",
         value(
             site::speed, [](Floats v, Run run) { v[0] = std::max(v[0], run.constants[0]); }, &moves_by_velocity),
         {},
         speed_of});
    all.push_back({"length_with_epsilon", "no hit: velocity / (length + a constant)",
                   value(site::direction,
                         [](Floats v, Run run) {
                             const glm::vec3 velocity = vec3(run, site::velocity);
                             set(v, velocity / (glm::length(velocity) + run.constants[0]));
                         }),
                   lengths});
    all.push_back({"collide_time_at_least",
                   "collide time is not counted below a constant",
                   value(site::collide_time, [](Floats v, Run run) { v[0] = std::max(v[0], run.constants[0]); }),
                   {},
                   collide_time_of});
    all.push_back({"velocity_stored_as_direction",
                   "no hit: the velocity is stored as the direction",
                   {.site = site::direction.id, .change = Change::not_done, .also = &moves_by_velocity}});
    all.push_back({"kept_above_x", "positions are kept above an x", plane<0, true>(), {}, plane_of<0>});
    all.push_back({"kept_above_y", "positions are kept above a y", plane<1, true>(), {}, plane_of<1>});
    all.push_back({"kept_above_z", "positions are kept above a z", plane<2, true>(), {}, plane_of<2>});
    all.push_back({"kept_below_x", "positions are kept below an x", plane<0, false>(), {}, plane_of<0>});
    all.push_back({"kept_below_y", "positions are kept below a y", plane<1, false>(), {}, plane_of<1>});
    all.push_back({"kept_below_z", "positions are kept below a z", plane<2, false>(), {}, plane_of<2>});
    all.push_back({"collide_time_stops_at_zero", "collide time is not counted below 0",
                   value(site::collide_time, [](Floats v, Run) { v[0] = std::max(v[0], 0.0F); })});
    all.push_back({"gravity_halved", "half of gravity", {.site = site::fall.id, .change = Change::halved}});
    all.push_back({"collide_time_set_by_every_search", "collide time begins anew with every search, hit or not",
                   value(site::collide_time, [](Floats v, Run run) {
                       if (real(run, site::collide_time_before) < 0.0F)
                           v[0] = params(run).constants.collision_time;
                   })});
    all.push_back({"collide_time_is_zero_after_search", "collide time is 0 after a search without a hit",
                   value(site::collide_time, [](Floats v, Run run) {
                       if (real(run, site::collide_time_before) < 0.0F)
                           v[0] = 0.0F;
                   })});
    rests(all, "no_fall_after_missed_search", "a particle that searches without a hit neither moves nor counts",
          "no_fall_after_missed_search_but_counts", "a particle that searches without a hit does not move",
          [](Run run) { return real(run, site::collide_time_before) < 0.0F; });
    rests(all, "rests_while_collide_time_runs", "a particle that does not search neither moves nor counts",
          "moves_only_when_searching", "a particle that does not search does not move",
          [](Run run) { return !(real(run, site::collide_time_before) < 0.0F); });
    rests(all, "rests_while_collide_time_is_above_zero",
          "a particle with a collide time above 0 neither moves nor counts", "moves_only_from_collide_time_zero_on",
          "a particle with a collide time above 0 neither moves nor is pulled",
          [](Run run) { return real(run, site::collide_time_before) > 0.0F; });
    const auto held = [&](std::string_view name, std::string_view meaning, Formula formula) {
        all.push_back({name, meaning, value(site::position, formula)});
    };
    held("held_until_it_searches", "a particle that does not search stays in place, and is still pulled",
         [](Floats v, Run run) {
             if (!(real(run, site::collide_time_before) < 0.0F))
                 set(v, before(run));
         });
    held("held_while_collide_time_is_above_zero",
         "a particle with a collide time above 0 stays in place, and is still pulled", [](Floats v, Run run) {
             if (real(run, site::collide_time_before) > 0.0F)
                 set(v, before(run));
         });
    static const Formula length_of_direction = [](Floats v, Run) { v[0] = 1.0F; };
    static const Mistake moves_by_speed = value(site::moves_by, [](Floats v, Run run) {
        v[0] = real(run, site::speed_before) * params(run).switches.speed_factor;
    });
    static const Mistake length_at_hit = value(site::speed_at_hit, length_of_direction, &moves_by_speed);
    static const Mistake falls_by_velocity = value(
        site::step, [](Floats v, Run run) { set(v, vec3(run, site::velocity)); }, &length_at_hit);
    all.push_back({"length_of_direction_stored_as_speed", "the direction's length is stored as the speed",
                   value(site::speed, length_of_direction, &falls_by_velocity)});
    static const Formula a_constant = [](Floats v, Run run) { v[0] = run.constants[0]; };
    all.push_back({"tick_is_a_constant", "a constant for u_Tick", value(site::tick, a_constant), {}, counted_of});
    all.push_back({"collide_time_counted_by_a_constant",
                   "no hit: collide time - a constant, not - u_Tick",
                   value(site::counted, a_constant),
                   {},
                   counted_of});
    all.push_back({"moves_for_a_constant",
                   "no hit: moves for a constant time, not for u_Tick",
                   value(site::move, [](Floats v, Run run) { set(v, vec3(run, site::step) * run.constants[0]); }),
                   {},
                   moved_for});
    all.push_back({"collide_time_counted_by_one",
                   "collide time - 1, not - tick",
                   {.site = site::counted.id, .change = Change::one}});
    const auto everywhere = [&](std::string_view name, std::string_view meaning, const Site& in_fall,
                                const Site& at_hit, Formula formula) {
        static std::deque<Mistake> of_hits; // their place stays
        const Mistake& too = of_hits.emplace_back(value(at_hit, formula));
        all.push_back({name, meaning, value(in_fall, formula, &too)});
    };
    everywhere("position_in_clip_space", "the position is stored in clip space", site::position, site::position_at_hit,
               [](Floats v, Run run) { set(v, glm::vec3(projected(run, get(v)))); });
    everywhere("position_in_ndc", "the position is stored in normalised device coordinates", site::position,
               site::position_at_hit, [](Floats v, Run run) {
                   const glm::vec4 clip = projected(run, get(v));
                   set(v, glm::vec3(clip) / clip.w);
               });
    static const Formula halves = [](Floats v, Run) {
        for (float& x : v)
            x = half_round(x);
    };
    everywhere("position_in_half_floats", "the position is rounded to half floats", site::position,
               site::position_at_hit, halves);
    everywhere("speed_in_half_floats", "the speed is rounded to half floats", site::speed, site::speed_at_hit, halves);
    everywhere("collide_time_in_half_floats", "collide time is rounded to half floats", site::collide_time,
               site::collide_time_at_hit, halves);
    all.push_back({"speed_along_old_direction", "no hit: the speed is the new velocity along the old direction",
                   value(site::speed,
                         [](Floats v, Run run) { v[0] = glm::dot(vec3(run, site::velocity), old_direction(run)); })});
    all.push_back({"speed_plus_gravity", "no hit: the speed grows by gravity's length, whatever the direction",
                   value(site::speed, [](Floats v, Run run) {
                       v[0] = real(run, site::speed_before) + glm::length(vec3(run, site::fall));
                   })});
    all.push_back({"drag_by_tick", "no hit: the speed is multiplied by 1 - a constant * u_Tick",
                   value(site::speed, [](Floats v, Run run) { v[0] *= 1.0F - run.constants[0] * tick(run); }), rates});
    all.push_back({"drag_by_exponential", "no hit: the speed is multiplied by exp(-a constant * u_Tick)",
                   value(site::speed, [](Floats v, Run run) { v[0] *= std::exp(-run.constants[0] * tick(run)); }),
                   rates});
    all.push_back({"drag_before_gravity", "no hit: the old speed is multiplied by a constant before gravity acts",
                   value(site::velocity_before, [](Floats v, Run run) { set(v, get(v) * run.constants[0]); }), drags});
    all.push_back(
        {"factor_before_gravity", "no hit: the old speed is multiplied by u_SpeedFactor before gravity acts",
         value(site::velocity_before, [](Floats v, Run run) { set(v, get(v) * params(run).switches.speed_factor); })});
    all.push_back({"collide_time_counted_above_zero", "collide time is counted only where it is above 0",
                   value(site::collide_time, [](Floats v, Run run) {
                       if (!(real(run, site::collide_time_before) > 0.0F))
                           v[0] = real(run, site::collide_time_before);
                   })});
    all.push_back({"collide_time_counted_from_zero", "collide time is counted only where it is 0 or above",
                   value(site::collide_time, [](Floats v, Run run) {
                       if (!(real(run, site::collide_time_before) >= 0.0F))
                           v[0] = real(run, site::collide_time_before);
                   })});
    all.push_back({"gravity_by_height", "gravity acts only above y = 0", value(site::fall, [](Floats v, Run run) {
                       if (!(before(run).y > 0.0F))
                           set(v, glm::vec3(0.0F));
                   })});
    all.push_back({"gravity_times_speed", "gravity * tick * speed",
                   value(site::fall, [](Floats v, Run run) { set(v, get(v) * real(run, site::speed_before)); })});
    all.push_back(
        {"gravity_of_constant_tick", "gravity acts for a constant time, not for u_Tick",
         value(site::fall, [](Floats v, Run run) { set(v, params(run).constants.gravity * run.constants[0]); }),
         ticks});
    all.push_back({"move_by_speed_alone", "no hit: moves by the speed along each axis",
                   value(site::step, [](Floats v, Run run) { set(v, glm::vec3(real(run, site::speed))); })});
    all.push_back({"move_by_direction_alone", "no hit: moves by the direction, without the speed",
                   value(site::step, [](Floats v, Run run) { set(v, vec3(run, site::direction)); })});
    all.push_back({"moves_along_old_direction", "no hit: moves along the old direction by the new speed",
                   value(site::step, [](Floats v, Run run) { set(v, old_direction(run) * real(run, site::speed)); })});
}

} // namespace lockstep::formulas
